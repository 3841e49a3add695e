#pragma once
#include <algorithm>
#include <cmath>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

// Density and support radius that belong together: rho_a is summed with the target's own H_a, and H_a is so large that
// the mass m_a fills a cell of side H_a/q at that density,
//   rho_sum_a(H_a) = m_a (q/H_a)^N,    q = H over spacing.
// A sweep of these sums takes H_ab = H_a (`takes_target_support`), whatever the rule for other pairs. The derivative is
//   dW/dH = -(N W + r dW/dr)/H,    r dW/dr = r_ab.grad_a W_ab.

/// dW/dH at constant r.
constexpr auto w_by_support(const auto& ab) { return -(double(ab.dim) * ab.w + dot(ab.dx, ab.grad_w)) / ab.support; }

/// Every neighbour counts as if it had the target's mass, so that density follows the number of particles per volume
/// and a jump of the particles' masses stays as sharp as it was made. For equal masses this is `grad_h_mass`.
struct DensityGradH {
  static constexpr Info info{"grad_h", "Number density times own mass, with its derivative by the support radius",
                             "rho_a = m_a sum_b W(r_ab, H_a), drho_a/dH_a = m_a sum_b dW/dH(r_ab, H_a)",
                             "Ott & Schnetter (2003); Monaghan (2005); Hopkins (2013), with weights of 1"};
  using reads = Fields<m>;
  using adds = Fields<rho_sum, rho_sum_h>;
  static constexpr bool takes_target_support = true;

  constexpr auto operator()(const auto& a, const auto&, const auto& ab) const {
    return adds::row(a.m * ab.w, a.m * w_by_support(ab));
  }
};

struct DensityGradHMass {
  static constexpr Info info{"grad_h_mass", "Density by summation, with its derivative by the support radius",
                             "rho_a = sum_b m_b W(r_ab, H_a), drho_a/dH_a = sum_b m_b dW/dH(r_ab, H_a)",
                             "Springel & Hernquist (2002); Price (2012), density with variable h"};
  using reads = Fields<m>;
  using adds = Fields<rho_sum, rho_sum_h>;
  static constexpr bool takes_target_support = true;

  constexpr auto operator()(const auto&, const auto& b, const auto& ab) const {
    return adds::row(b.m * ab.w, b.m * w_by_support(ab));
  }
};

/// Omega = 1 + H/(N rho) drho/dH, from dH/drho = -H/(N rho): where H follows density, density changes by 1/Omega of
/// what it would with H held. Springel & Hernquist (2002); Price (2012).
template <int N>
constexpr double grad_h_factor(double H, double rho_sum, double rho_sum_h) {
  return 1 + H / (N * rho_sum) * rho_sum_h;
}

/// One particle's sums at its present H.
struct SupportState {
  double m, H, rho_sum, rho_sum_h;
};

/// The next H on the way to rho_sum(H) = m (q/H)^N, by Newton on the logarithms of both sides, which on a lattice is
/// nearly a straight line:
///   F(ln H) = ln rho_sum + N ln H - ln m - N ln q,  F' = N Omega,  H_next = H exp(-F/F').
/// H at most doubles or halves in a step, and Omega counts as at least 0.1: a lone particle, whose Omega is 0 at every
/// H, doubles its H until it has a neighbour.
template <int N>
double next_support(const SupportState& a, double q) {
  const double excess = std::log(a.rho_sum / a.m) + N * std::log(a.H / q);
  const double omega = std::max(grad_h_factor<N>(a.H, a.rho_sum, a.rho_sum_h), 0.1);
  return a.H * std::clamp(std::exp(-excess / (N * omega)), 0.5, 2.0);
}

/// How far density and H are apart, relative: what the iteration brings to zero.
template <int N>
double support_mismatch(const SupportState& a, double q) {
  return a.rho_sum / a.m * std::pow(a.H / q, N) - 1;
}

}  // namespace undine::terms
