#include <string>

#include <gtest/gtest.h>

#include "unit/terms/gas_pairs.hpp"

// Properties of the terms of gases: in single pairs at random, and summed over small crowds pair by pair.

namespace undine {
namespace {

using namespace field;
using test::gas_pair;
using test::GasParticle;
using test::in_every_dimension;
using test::Random;
using test::random_particle;

constexpr int trials = 300;
const KernelChoice kernel = KernelChoice::of<WendlandC2>();

/// What a term gives to both of a pair.
template <int N, class Term>
struct Both {
  using Row = typename Term::adds::template Row<N, double>;
  Row a{}, b{};

  Both(const Term& term, const GasParticle<N>& left, const GasParticle<N>& right) {
    const auto ab = gas_pair<N>(left, right, kernel), ba = gas_pair<N>(right, left, kernel);
    const auto on_a = term(left, right, ab), on_b = term(right, left, ba);
    Term::adds::for_each([&]<class F>(F) {
      F::of(a) = F::of(on_a);
      F::of(b) = F::of(on_b);
    });
  }
};

/// Calls f(a, b) for pairs at random that are within the support.
template <int N, class F>
void for_pairs(F f) {
  Random random(N);
  int near = 0;
  while (near < trials) {
    const auto a = random_particle<N>(random), b = random_particle<N>(random);
    if (norm(a.x - b.x) > 0.6) continue;
    f(a, b);
    ++near;
  }
}

template <class F>
void for_each_gas_term(F f) {
  terms::GasPressureForms::for_each(f);
  terms::EnergyForms::for_each(f);
  terms::GasViscosities::for_each(f);
  terms::StressForms::for_each(f);
  terms::Conductivities::for_each(f);
}

// ---- Conservation in a pair
// ------------------------------------------------------------------------------------------

// Criterion: m_a acc_a + m_b acc_b = 0 to 1e-14 of the forces, or 1e-15 of the parts of order 1 that they are made of.
TEST(GasTerms, ForcesOfAPairAreOpposite) {
  in_every_dimension([]<int N>() {
    for_each_gas_term([]<class Term>(const Term& term) {
      if constexpr (Term::adds::template has<acc>) {
        for_pairs<N>([&](const auto& a, const auto& b) {
          const Both<N, Term> on(term, a, b);
          const Vec<N> f_a = a.m * on.a.acc, f_b = b.m * on.b.acc;
          EXPECT_LE(norm(f_a + f_b), 1e-14 * (norm(f_a) + norm(f_b)) + 1e-15) << Term::info.name << ' ' << N;
        });
      }
    });
  });
}

/// Power that the force puts into the motion of the pair, and the heat of the energy term, largest sum relative to
/// parts.
template <int N, class Pressure, class Energy>
double unmatched() {
  double worst = 0;
  for_pairs<N>([&](const auto& a, const auto& b) {
    const Both<N, Pressure> force({}, a, b);
    const Both<N, Energy> work({}, a, b);
    const double motion = a.m * dot(a.v, force.a.acc) + b.m * dot(b.v, force.b.acc);
    const double heat_a = a.m * work.a.de, heat_b = b.m * work.b.de;
    worst = std::max(worst, std::abs(motion + heat_a + heat_b) /
                                (a.m * norm(force.a.acc) * norm(a.v) + b.m * norm(force.b.acc) * norm(b.v) +
                                 std::abs(heat_a) + std::abs(heat_b) + 1e-300));
  });
  return worst;
}

// Criterion: what a pressure form takes from the motion of a pair its partners give as internal energy, to 1e-13; all
// other pairings miss by more than 1 %.
TEST(GasTerms, WorkOfPressureConservesEnergyForPartnersAndForNoOthers) {
  in_every_dimension([]<int N>() {
    terms::GasPressureForms::for_each([]<class Pressure>(Pressure) {
      terms::EnergyForms::for_each([]<class Energy>(Energy) {
        constexpr auto is = []<class P, class E>(P, E) {
          return std::is_same_v<P, Pressure> && std::is_same_v<E, Energy>;
        };
        constexpr bool partners = Pressure::info.name == Energy::info.name ||
                                  is(terms::PressureSymmetric{}, terms::EnergyOwn{}) ||
                                  is(terms::PressureSum{}, terms::EnergyOwnVolume{});
        const double left = unmatched<N, Pressure, Energy>();
        if (partners)
          EXPECT_LE(left, 1e-13) << Pressure::info.name << " with " << Energy::info.name << ' ' << N;
        else
          EXPECT_GE(left, 0.01) << Pressure::info.name << " with " << Energy::info.name << ' ' << N;
      });
    });
  });
}

// Criterion: viscosities take from the motion of a pair exactly the heat that they give, to 1e-13.
TEST(GasTerms, ViscositiesHeatByWhatTheyTakeFromTheMotion) {
  in_every_dimension([]<int N>() {
    const auto conserves = []<class Term>(Term) { EXPECT_LE((unmatched<N, Term, Term>()), 1e-13) << Term::info.name; };
    terms::GasViscosities::for_each(conserves);
    terms::StressForms::for_each(conserves);
  });
}

// Criterion: a velocity common to both changes nothing by more than 1e-13.
TEST(GasTerms, AreGalileanInvariant) {
  in_every_dimension([]<int N>() {
    for_each_gas_term([]<class Term>(const Term& term) {
      for_pairs<N>([&](auto a, auto b) {
        const Both<N, Term> still(term, a, b);
        for (auto* one : {&a, &b})
          for (int k = 0; k < N; ++k) one->v[k] += 3 - k;
        const Both<N, Term> moving(term, a, b);
        Term::adds::for_each([&]<class F>(F) {
          if constexpr (F::info.rank == Rank::scalar)
            EXPECT_NEAR(F::of(still.a), F::of(moving.a), 1e-12 * (1 + std::abs(F::of(still.a)))) << Term::info.name;
          else
            EXPECT_LE(norm(F::of(still.a) - F::of(moving.a)), 1e-12 * (1 + norm(F::of(still.a)))) << Term::info.name;
        });
      });
    });
  });
}

// ---- Artificial viscosity
// --------------------------------------------------------------------------------------------

// Criterion: heat is positive for both of a pair that approaches, half of it each by mass; nothing acts on a pair that
// parts.
TEST(GasTerms, ViscositiesHeatOnApproachAndLeaveWhatPartsAlone) {
  in_every_dimension([]<int N>() {
    terms::GasViscosities::for_each([]<class Term>(const Term& term) {
      int approaching = 0;
      for_pairs<N>([&](const auto& a, const auto& b) {
        const Both<N, Term> on(term, a, b);
        if (dot(a.v - b.v, a.x - b.x) < 0) {
          ++approaching;
          EXPECT_GT(on.a.de, 0) << Term::info.name;
          EXPECT_NEAR(a.m * on.a.de / (b.m * on.b.de), 1, 1e-12) << Term::info.name;
        } else {
          EXPECT_EQ(on.a.de, 0) << Term::info.name;
          EXPECT_EQ(norm(on.a.acc), 0) << Term::info.name;
        }
      });
      EXPECT_GT(approaching, trials / 4);
    });
  });
}

// Criterion: with alpha of all the same and no limiter, the force is that of liquids' `monaghan`, to 1e-14.
TEST(GasTerms, MonaghansViscosityIsThatOfLiquids) {
  in_every_dimension([]<int N>() {
    const terms::GasViscosityMonaghan gas{.alpha = 0.7, .beta = 1.9};
    const terms::ViscosityMonaghan liquid{.alpha = 0.7, .beta = 1.9};
    for_pairs<N>([&](auto a, auto b) {
      a.alpha_v = b.alpha_v = 0.7;
      a.balsara = b.balsara = 1;
      const auto ab = gas_pair<N>(a, b, kernel);
      const Vec<N> one = gas(a, b, ab).acc, other = liquid(a, b, ab).acc;
      EXPECT_LE(norm(one - other), 1e-14 * norm(other));
    });
  });
}

// Criterion: alpha and limiter are means of the pair: with the limiter at 0 on one side the force halves; with alpha
// and beta 0 there is none; to 1e-14.
TEST(GasTerms, AlphaAndLimiterAreMeansOfThePair) {
  terms::GasViscosities::for_each([]<class Term>(Term term) {
    for_pairs<2>([&](auto a, auto b) {
      a.balsara = b.balsara = 1;
      const double whole = Both<2, Term>(term, a, b).a.de;
      b.balsara = 0;
      EXPECT_NEAR((Both<2, Term>(term, a, b).a.de), whole / 2, 1e-14 * whole);
      term.beta = 0;
      const double linear = Both<2, Term>(term, a, b).a.de;
      std::swap(a.alpha_v, b.alpha_v);
      EXPECT_NEAR((Both<2, Term>(term, a, b).a.de), linear, 1e-14 * linear);
      a.alpha_v = b.alpha_v = 0;
      EXPECT_EQ((Both<2, Term>(term, a, b).a.de), 0);
      term.beta = Term{}.beta;
    });
  });
}

// Criterion: as by hand for two particles at distance 0.5 that meet head on at 3 m/s, c = 2, to 1e-12; the 0.01 h^2 is
// the regularisation of the distance.
TEST(GasTerms, SignalViscosityAsByHand) {
  Random random(1);
  auto a = random_particle<1>(random), b = a;
  a.x = {{0.5}}, b.x = {{0}}, a.v = {{-1}}, b.v = {{2}};
  a.c = b.c = 2, a.rho = b.rho = 1.5, a.alpha_v = b.alpha_v = 0.8, a.balsara = b.balsara = 1, a.h = b.h = 1;
  const double w = -3 * 0.25 / (0.25 + 0.01 * 0.25);
  const double pi_ab = (-0.8 * 2 * w + 2 * w * w) / 1.5;
  const double slope = gas_pair<1>(a, b, kernel).grad_w[0];
  const Both<1, terms::GasViscositySignal> on({}, a, b);
  EXPECT_NEAR(on.a.acc[0], -b.m * pi_ab * slope, 1e-12);
  EXPECT_NEAR(on.a.de, 0.5 * b.m * pi_ab * -3 * slope, 1e-12);
  EXPECT_GT(on.a.acc[0], 0);  // held back
}

// Criterion: c and closing speed for a pair that approaches, c alone for one that parts; to 1e-12.
TEST(GasTerms, SignalSpeedIsThatOfSoundAndOfApproach) {
  for_pairs<2>([&](const auto& a, const auto& b) {
    const auto ab = gas_pair<2>(a, b, kernel);
    const double c_mean = 0.5 * (a.c + b.c), closing = -dot(a.v - b.v, ab.dx) * ab.r * ab.inv_r_sq;
    EXPECT_NEAR((terms::SignalSpeed{}(a, b, ab).v_signal), c_mean + std::max(closing, 0.0), 1e-12);
  });
}

// ---- Conductivity
// ----------------------------------------------------------------------------------------------------

// Criterion: heat only moves (m_a de_a = -m_b de_b to 1e-14), from the hotter to the colder, and not at all where
// energy is even, nor where what drives the form is: pressure of one, velocity of the other.
TEST(GasTerms, ConductivityMovesHeatFromHotToCold) {
  in_every_dimension([]<int N>() {
    terms::Conductivities::for_each([]<class Term>(const Term&) {
      for_pairs<N>([](auto a, auto b) {
        const Both<N, Term> on({}, a, b);
        EXPECT_NEAR(a.m * on.a.de, -b.m * on.b.de, 1e-14 * std::abs(a.m * on.a.de));
        EXPECT_LT(on.a.de * (a.e - b.e), 0);
        const auto same_energy = [](auto one, const auto& other) { return one.e = other.e, one; };
        EXPECT_EQ((Both<N, Term>({}, a, same_energy(b, a)).a.de), 0);
        if constexpr (std::is_same_v<Term, terms::ConductivityPressure>) b.p = a.p;
        if constexpr (std::is_same_v<Term, terms::ConductivityVelocity>) b.v = a.v;
        EXPECT_EQ((Both<N, Term>({}, a, b).a.de), 0);
      });
    });
  });
}

// ---- Stress
// ----------------------------------------------------------------------------------------------------------

// Criterion: exactly none of rotation in 3-D; of expansion none in 3-D (trace 2/3 div v), 2 k (1 - N/3) on the diagonal
// in fewer; 2 on the off-diagonal for shear with d v_x/dy = 2.
TEST(GasTerms, StressIsOfShearAloneAndFreeOfTraceInSpace) {
  in_every_dimension([]<int N>() {
    Vec<N, Vec<N>> expansion{};
    for (int k = 0; k < N; ++k) expansion[k][k] = 1.5;
    const auto epsilon = terms::deviator(expansion);
    for (int k = 0; k < N; ++k) EXPECT_NEAR(epsilon[k][k], 3 * (1 - N / 3.0), 1e-15);
  });
  const Vec<3, Vec<3>> rotation{{{{0, 1, -2}}, {{-1, 0, 3}}, {{2, -3, 0}}}};
  EXPECT_EQ(terms::deviator(rotation), (Vec<3, Vec<3>>{}));
  const Vec<2, Vec<2>> shear{{{{0, 0}}, {{2, 0}}}};
  EXPECT_EQ(terms::deviator(shear), (Vec<2, Vec<2>>{{{{0, 2}}, {{2, 0}}}}));
}

/// A lattice with spacing 1/side on [0, 1]^N.
template <int N>
std::vector<GasParticle<N>> lattice(int side, double support, double disorder = 0) {
  Random random(7);
  std::vector<GasParticle<N>> crowd;
  int count = 1;
  for (int k = 0; k < N; ++k) count *= side;
  for (int cell = 0; cell < count; ++cell) {
    GasParticle<N> a = random_particle<N>(random);
    int rest = cell;
    for (int k = 0; k < N; ++k, rest /= side) a.x[k] = (rest % side + 0.5 + random.between(-disorder, disorder)) / side;
    a.m = std::pow(1.0 / side, N);
    a.rho = 1;
    a.mu = 0.3;
    a.h = support / side;
    crowd.push_back(a);
  }
  return crowd;
}

template <int N, class Form>
void stress_of(std::vector<GasParticle<N>>& crowd, const KernelChoice& with) {
  test::sum_all<N>(crowd, with, terms::VelocityGradient{});
  for (auto& a : crowd) a.stress = a.mu * terms::deviator(a.strain);
  test::sum_all<N>(crowd, with, Form{});
}

// Criterion: acc = mu/rho (lap v + 1/3 grad div v) in the middle of a lattice, within 3 %: 4/3 mu/rho for v_x = x^2/2,
// mu/rho for v_x = y^2/2.
TEST(GasTerms, StressApproachesTheNavierStokesForce) {
  const KernelChoice smooth = KernelChoice::of<WendlandC4>();
  terms::StressForms::for_each([&]<class Form>(Form) {
    for (const int along : {0, 1}) {
      auto crowd = lattice<2>(21, 4);
      for (auto& a : crowd) a.v = {{0.5 * sq(a.x[along] - 0.5), 0}};
      stress_of<2, Form>(crowd, smooth);
      const auto& middle = crowd[21 * 10 + 10];
      EXPECT_NEAR(middle.acc[0] / middle.mu, along == 0 ? 4.0 / 3 : 1, 0.03) << Form::info.name;
      EXPECT_NEAR(middle.acc[1], 0, 1e-12) << Form::info.name;
    }
  });
}

// Criterion: heat of `stress_sum` is mu/(2 rho) epsilon:epsilon of each particle, normal components across included, to
// 1e-12: never negative.
TEST(GasTerms, StressHeatsByEpsilonSquared) {
  in_every_dimension([]<int N>() {
    auto crowd = lattice<N>(N == 1 ? 12 : N == 2 ? 7 : 5, 2.6, 0.2);
    stress_of<N, terms::ViscousStressSum>(crowd, kernel);
    for (const auto& a : crowd) {
      const auto epsilon = terms::deviator(a.strain);
      double square = (3 - N) * sq(-2.0 / 3 * terms::divergence(a.strain));
      for (int i = 0; i < N; ++i) square += norm_sq(epsilon[i]);
      EXPECT_NEAR(a.de, a.mu / (2 * a.rho) * square, 1e-12 * square) << N;
    }
  });
}

}  // namespace
}  // namespace undine
