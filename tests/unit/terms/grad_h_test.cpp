#include <numeric>

#include <gtest/gtest.h>

#include "unit/terms/gas_pairs.hpp"

// Density and support radius by each other, and the forces and rates that follow from them: against numerical
// derivatives of the energy.

namespace undine {
namespace {

using test::GasParticle;
using test::in_every_dimension;
using test::Random;

const KernelChoice kernel = KernelChoice::of<WendlandC4>();
constexpr double q = 2.6, gamma = 1.4;

/// A small crowd in a unit cube, out of order and of unequal masses, each with its own entropy.
template <int N>
struct Cloud {
  std::vector<GasParticle<N>> particles;
  std::vector<double> entropy;

  explicit Cloud(std::uint64_t seed = 3) {
    Random random(seed);
    const int side = N == 1 ? 12 : N == 2 ? 5 : 3;
    int count = 1;
    for (int k = 0; k < N; ++k) count *= side;
    for (int cell = 0; cell < count; ++cell) {
      auto a = test::random_particle<N>(random);
      int rest = cell;
      for (int k = 0; k < N; ++k, rest /= side) a.x[k] = (rest % side + random.between(0.2, 0.8)) / side;
      a.m = random.between(0.5, 1.5) / count;
      a.h = q / side;
      particles.push_back(a);
      entropy.push_back(random.between(0.5, 1.5));
    }
  }

  /// rho, H, omega of the positions; e and p on each particle's isentrope.
  template <class Density>
  void follow() {
    test::settle<N, Density>(particles, kernel, q);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      auto& a = particles[i];
      a.e = entropy[i] * std::pow(a.rho, gamma - 1) / (gamma - 1);
      a.p = (gamma - 1) * a.rho * a.e;
    }
  }
  double internal_energy() const {
    return std::accumulate(particles.begin(), particles.end(), 0.0,
                           [](double sum, const auto& a) { return sum + a.m * a.e; });
  }
};

/// The forms that belong together.
template <class DensityForm, class PressureForm, class EnergyForm>
struct Family {
  using Density = DensityForm;
  using Pressure = PressureForm;
  using Energy = EnergyForm;
};
template <class F>
void for_each_family(F f) {
  f(Family<terms::DensityGradH, terms::PressureGradH, terms::EnergyGradH>{});
  f(Family<terms::DensityGradHMass, terms::PressureGradHMass, terms::EnergyGradHMass>{});
}

// Criterion: dW/dH as by central differences, to 1e-7 of W/H.
TEST(GradH, KernelsChangeWithTheirSupportAsTheDerivativeSays) {
  in_every_dimension([]<int N>() {
    Random random(5);
    Kernels::for_each([&]<class K>(K) {
      const auto choice = KernelChoice::of<K>();
      for (const double R : {0.0, 0.2, 0.45, 0.7, 0.9}) {
        auto a = test::random_particle<N>(random), b = a;
        const double H = 0.8, d = 1e-5 * H;
        b.x[0] += R * H;
        const auto at = [&](double support) { return test::gas_pair<N>(a, b, choice, support); };
        const double numeric = (at(H + d).w - at(H - d).w) / (2 * d);
        EXPECT_NEAR(terms::w_by_support(at(H)), numeric, 1e-7 / std::pow(H, N + 1))
            << K::info.name << ' ' << N << ' ' << R;
      }
    });
  });
}

// Criterion: - m_k acc_k is the derivative of the crowd's internal energy by x_k at constant entropy, H following
// density, by central differences, to 1e-6 of the largest force.
TEST(GradH, PressureForceIsTheGradientOfTheInternalEnergy) {
  in_every_dimension([]<int N>() {
    for_each_family([]<class Forms>(Forms) {
      Cloud<N> cloud;
      cloud.template follow<typename Forms::Density>();
      test::sum_all<N>(cloud.particles, kernel, typename Forms::Pressure{});
      double largest = 0;
      for (const auto& a : cloud.particles) largest = std::max(largest, a.m * norm(a.acc));
      for (const std::size_t k : {std::size_t{0}, cloud.particles.size() / 2}) {
        for (int axis = 0; axis < N; ++axis) {
          const double d = 1e-5;
          const auto moved = [&](double by) {
            Cloud<N> other = cloud;
            other.particles[k].x[axis] += by;
            other.template follow<typename Forms::Density>();
            return other.internal_energy();
          };
          const double force = -(moved(d) - moved(-d)) / (2 * d);
          EXPECT_NEAR(cloud.particles[k].m * cloud.particles[k].acc[axis], force, 1e-6 * largest)
              << Forms::Pressure::info.name << ' ' << N;
        }
      }
    });
  });
}

// Criterion: de/dt is the change of e at constant entropy as all particles go on with their velocities, by central
// differences, to 1e-6 of the largest rate.
TEST(GradH, WorkKeepsEntropy) {
  in_every_dimension([]<int N>() {
    for_each_family([]<class Forms>(Forms) {
      Cloud<N> cloud;
      cloud.template follow<typename Forms::Density>();
      test::sum_all<N>(cloud.particles, kernel, typename Forms::Energy{});
      double largest = 0;
      for (const auto& a : cloud.particles) largest = std::max(largest, std::abs(a.de));
      const double dt = 1e-5;
      const auto later = [&](double by) {
        Cloud<N> other = cloud;
        for (auto& a : other.particles) a.x += by * a.v;
        other.template follow<typename Forms::Density>();
        return other;
      };
      const auto after = later(dt), before = later(-dt);
      for (std::size_t i = 0; i < cloud.particles.size(); ++i)
        EXPECT_NEAR(cloud.particles[i].de, (after.particles[i].e - before.particles[i].e) / (2 * dt), 1e-6 * largest)
            << Forms::Energy::info.name << ' ' << N;
    });
  });
}

// Criterion: for equal masses both densities are one, to 1e-14; for unequal ones they differ by more than 1 %
// somewhere.
TEST(GradH, DensitiesAgreeForEqualMasses) {
  in_every_dimension([]<int N>() {
    Cloud<N> number, mass;
    for (auto* cloud : {&number, &mass})
      for (auto& a : cloud->particles) a.m = 1.0 / static_cast<double>(cloud->particles.size());
    const auto largest_difference = [&] {
      number.template follow<terms::DensityGradH>();
      mass.template follow<terms::DensityGradHMass>();
      double worst = 0;
      for (std::size_t i = 0; i < number.particles.size(); ++i)
        worst = std::max(worst, std::abs(number.particles[i].rho / mass.particles[i].rho - 1));
      return worst;
    };
    EXPECT_LE(largest_difference(), 1e-13);
    number = mass = Cloud<N>();
    EXPECT_GE(largest_difference(), 0.01);
  });
}

/// rho_sum and its derivative at the middle of an endless lattice of unit spacing and density.
template <int N>
terms::SupportState on_lattice(double H) {
  terms::SupportState state{1, H, 0, 0};
  const int reach = static_cast<int>(H) + 1, width = 2 * reach + 1;
  int count = 1;
  for (int k = 0; k < N; ++k) count *= width;
  Random random(1);
  const auto a = test::random_particle<N>(random);
  for (int cell = 0; cell < count; ++cell) {
    auto b = a;
    int rest = cell;
    for (int k = 0; k < N; ++k, rest /= width) b.x[k] += rest % width - reach;
    const auto ab = test::gas_pair<N>(a, b, kernel, H);
    state.rho_sum += ab.w;
    state.rho_sum_h += terms::w_by_support(ab);
  }
  return state;
}

// Criterion: from a third to thrice the answer, at most 12 steps to a mismatch of 1e-13; the answer is q spacings
// within 2 %, density 1 within 6 %, and stays itself; no step by more than a factor of 2; and the last steps square the
// error.
TEST(GradH, SupportConvergesOnALattice) {
  in_every_dimension([]<int N>() {
    for (const double factor : {0.34, 0.7, 1.0, 1.4, 3.0}) {
      double H = factor * q;
      int steps = 0;
      std::vector<double> errors;
      for (; steps < 13; ++steps) {
        const auto state = on_lattice<N>(H);
        errors.push_back(std::abs(terms::support_mismatch<N>(state, q)));
        if (errors.back() <= 1e-13) break;
        const double next = terms::next_support<N>(state, q);
        EXPECT_LE(next, 2 * H);
        EXPECT_GE(next, H / 2);
        H = next;
      }
      EXPECT_LE(steps, 12) << N << ' ' << factor;
      EXPECT_NEAR(H / q, 1, 0.02) << N;
      EXPECT_NEAR(on_lattice<N>(H).rho_sum, 1, 0.06) << N;
      EXPECT_NEAR(terms::next_support<N>(on_lattice<N>(H), q) / H, 1, 1e-13) << N;
      for (std::size_t k = 1; k < errors.size(); ++k)
        if (errors[k - 1] < 0.05) {
          EXPECT_LE(errors[k], 5 * sq(errors[k - 1]) + 1e-13) << N << ' ' << factor;
        }
    }
  });
}

// Criterion: a particle without neighbours doubles its H; one in a crowd halves it.
TEST(GradH, SupportIsBoundedWithoutNeighboursAndInACrowd) {
  in_every_dimension([]<int N>() {
    const double H = 0.2, w_0 = kernel.w<N>(0.0) / std::pow(H, N);
    EXPECT_EQ(terms::next_support<N>({1, H, w_0, -N * w_0 / H}, q), 2 * H);
    EXPECT_EQ(terms::next_support<N>({1, H, 1e4 * w_0, 0}, q), H / 2);
  });
}

}  // namespace
}  // namespace undine
