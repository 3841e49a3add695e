#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "undine/engine/pair.hpp"
#include "undine/terms/catalogue.hpp"
#include "unit/engine/crowd.hpp"

namespace undine::test {

/// Every field that a term of gases reads or adds to.
using GasFields = Fields<field::x, field::v, field::m, field::rho, field::p, field::c, field::e, field::h, field::mu,
                         field::omega, field::alpha_v, field::balsara, field::stress, field::strain, field::acc,
                         field::de, field::rho_sum, field::rho_sum_h, field::div_acc, field::v_signal>;
template <int N>
using GasParticle = GasFields::Row<N, double>;

constexpr double gas_kappa = 2;

/// What a term sees of two particles, with gradients by the supports of both.
template <int N>
struct GasPair : Pair<N, double> {
  Vec<N> grad_w_a, grad_w_b;
};

template <int N>
GasPair<N> gas_pair(const GasParticle<N>& a, const GasParticle<N>& b, const KernelChoice& kernel, double H) {
  const auto gradient = [&](const Vec<N>& dx, double support) {
    return dx * (kernel.slope_over_R<N>(norm(dx) / support) / std::pow(support, N + 2));
  };
  GasPair<N> ab{};
  ab.dx = a.x - b.x;
  ab.r = norm(ab.dx);
  ab.r_sq = norm_sq(ab.dx);
  ab.support = H;
  ab.h = H / gas_kappa;
  ab.inv_r_sq = 1 / (ab.r_sq + 0.01 * sq(ab.h));
  ab.inv_rho = 2 / (a.rho + b.rho);
  ab.w = kernel.w<N>(ab.r / H) / std::pow(H, N);
  ab.grad_w = gradient(ab.dx, H);
  ab.grad_w_a = gradient(ab.dx, a.h);
  ab.grad_w_b = gradient(ab.dx, b.h);
  ab.inside = ab.r < H;
  ab.kernel = &kernel;
  return ab;
}
/// H_ab is the mean of both.
template <int N>
GasPair<N> gas_pair(const GasParticle<N>& a, const GasParticle<N>& b, const KernelChoice& kernel) {
  return gas_pair<N>(a, b, kernel, 0.5 * (a.h + b.h));
}

/// A particle with everything at random, within a unit of the origin.
template <int N>
GasParticle<N> random_particle(Random& random) {
  GasParticle<N> a{};
  a.x = random.vector<N>(0.4);
  a.v = random.vector<N>(1);
  a.acc = random.vector<N>(1);
  for (double* positive : {&a.m, &a.rho, &a.p, &a.c, &a.e, &a.h, &a.mu, &a.omega, &a.alpha_v})
    *positive = random.between(0.7, 1.5);
  a.balsara = random.between(0, 1);
  for (int i = 0; i < N; ++i)
    for (int j = 0; j <= i; ++j) a.stress[i][j] = a.stress[j][i] = random.between(-1, 1);
  return a;
}

/// Which pairs count for a largest value: those within the mean of both H, or, as in sweeps that take both, within
/// either.
enum class Neighbourhood { mean, either };

/// Adds what the term gives to each particle, over all pairs; sums with the target's own support where it wants that.
template <int N, class Term>
void sum_all(std::vector<GasParticle<N>>& crowd, const KernelChoice& kernel, const Term& term,
             Neighbourhood near = Neighbourhood::mean) {
  for (auto& a : crowd) {
    typename Term::adds::template Row<N, double> total{};
    for (const auto& b : crowd) {
      const auto ab = [&] {
        if constexpr (requires { Term::takes_target_support; })
          return gas_pair<N>(a, b, kernel, a.h);
        else
          return gas_pair<N>(a, b, kernel);
      }();
      const auto one = term(a, b, ab);
      Term::adds::for_each([&]<class F>(F) {
        if constexpr (F::info.join == Join::max) {
          if (near == Neighbourhood::either ? ab.r < std::max(a.h, b.h) : ab.inside)
            F::of(total) = std::max(F::of(total), F::of(one));
        } else {
          F::of(total) += F::of(one);
        }
      });
    }
    Term::adds::for_each([&]<class F>(F) { F::of(a) = F::of(total); });
  }
}

/// H, rho and omega of all, brought to agree.
template <int N, class Density>
void settle(std::vector<GasParticle<N>>& crowd, const KernelChoice& kernel, double q) {
  double worst = 1;
  for (int k = 0; k < 100 && worst > 1e-14; ++k) {
    sum_all<N>(crowd, kernel, Density{});
    worst = 0;
    for (auto& a : crowd) {
      const terms::SupportState now{a.m, a.h, a.rho_sum, a.rho_sum_h};
      worst = std::max(worst, std::abs(terms::support_mismatch<N>(now, q)));
      a.rho = a.rho_sum;
      a.omega = terms::grad_h_factor<N>(a.h, a.rho_sum, a.rho_sum_h);
      if (worst > 1e-14) a.h = terms::next_support<N>(now, q);
    }
  }
}

template <class F>
void in_every_dimension(F f) {
  f.template operator()<1>();
  f.template operator()<2>();
  f.template operator()<3>();
}

}  // namespace undine::test
