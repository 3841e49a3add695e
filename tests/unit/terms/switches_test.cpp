#include <gtest/gtest.h>

#include "undine/terms/catalogue.hpp"

// The switches of the artificial viscosity, as functions of one particle.

namespace undine {
namespace {

using namespace field;
using terms::SwitchStep;
using Gradient = Vec<2, Vec<2>>;

struct State {
  Gradient strain{};
  double div_acc = 0, v_signal = 2, c = 1, alpha_v = 0.5;
};

constexpr double h = 0.05, H = 0.1;
Gradient expanding(double rate) { return {{{{rate / 2, 0}}, {{0, rate / 2}}}}; }
Gradient turning(double rate) { return {{{{0, rate}}, {{-rate, 0}}}}; }
Gradient shearing(double rate) { return {{{{0, 0}}, {{rate, 0}}}}; }

template <class Switch>
double next(const Switch& rule, const State& a, double dt) {
  return rule.template next<2>(a, SwitchStep{dt, h, H});
}

// Criterion: exactly, for gradients with L_ij = d v_j/d x_i.
TEST(Switches, InvariantsOfTheVelocityGradient) {
  EXPECT_EQ(terms::divergence(expanding(3)), 3);
  EXPECT_EQ(terms::curl_sq(expanding(3)), 0);
  EXPECT_EQ(terms::curl_sq(turning(3)), 36);  // curl v = 2 omega
  EXPECT_EQ(terms::curl_sq(shearing(3)), 9);
  EXPECT_EQ(terms::stretching(turning(3)), -18);
  EXPECT_EQ(terms::stretching(shearing(3)), 0);
  EXPECT_EQ(terms::curl_sq(Vec<3, Vec<3>>{{{{0, 3, 0}}, {{-3, 0, 0}}, {{0, 0, 7}}}}), 36);
  EXPECT_EQ(terms::curl_sq(Vec<1, Vec<1>>{{{{4}}}}), 0);
}

// Criterion: 1 in compression and expansion within 1e-4, at most 1e-4 in shear and rotation, 1/2 for both alike.
TEST(Switches, BalsaraTellsCompressionFromShear) {
  EXPECT_NEAR(terms::balsara_factor<2>(expanding(-100), 1, h), 1, 1e-4);
  EXPECT_NEAR(terms::balsara_factor<2>(expanding(100), 1, h), 1, 1e-4);
  EXPECT_LE(terms::balsara_factor<2>(shearing(100), 1, h), 1e-4);
  EXPECT_LE(terms::balsara_factor<2>(turning(100), 1, h), 1e-4);
  const Gradient both{{{{-50, 0}}, {{100, -50}}}};
  EXPECT_NEAR(terms::balsara_factor<2>(both, 1, h), 0.5, 1e-4);
  EXPECT_EQ(terms::balsara_factor<2>(Gradient{}, 1, h), 0);  // at rest: finite
}

TEST(Switches, NoneChangesNothing) {
  State a;
  a.strain = expanding(-100);
  EXPECT_EQ(next(terms::SwitchNone{}, a, 1), a.alpha_v);
}

// Criterion: the rate of the equation, by a short step, to 1e-6.
TEST(Switches, MorrisMonaghanFollowsItsEquation) {
  const terms::SwitchMorrisMonaghan rule{};
  for (const double rate : {-30.0, -1.0, 0.0, 5.0}) {
    State a;
    a.strain = expanding(rate);
    const double dt = 1e-8, f = terms::balsara_factor<2>(a.strain, a.c, h);
    const double expected =
        (rule.alpha_min - a.alpha_v) * rule.sigma * a.c / h + (rule.alpha_max - a.alpha_v) * f * std::max(-rate, 0.0);
    EXPECT_NEAR((next(rule, a, dt) - a.alpha_v) / dt, expected, 1e-6 * (1 + std::abs(expected))) << rate;
  }
}

// Criterion: within [alpha_min, alpha_max] for steps of any length, alpha_min long after a shock, near alpha_max in
// one, and no growth in shear.
TEST(Switches, MorrisMonaghanStaysWithinItsBounds) {
  const terms::SwitchMorrisMonaghan rule{};
  for (const double rate : {-1e6, -10.0, 0.0, 1e6})
    for (const double dt : {1e-6, 1e-2, 1.0, 1e6}) {
      State a;
      a.strain = expanding(rate);
      const double alpha = next(rule, a, dt);
      EXPECT_GE(alpha, rule.alpha_min);
      EXPECT_LE(alpha, rule.alpha_max);
    }
  State a;
  EXPECT_NEAR(next(rule, a, 1e3), rule.alpha_min, 1e-12);
  a.strain = expanding(-1e5);
  EXPECT_NEAR(next(rule, a, 1), rule.alpha_max, 1e-3);
  a.strain = shearing(1e5);
  EXPECT_LT(next(rule, a, 1e-3), a.alpha_v);
}

/// Compression that grows at `growth` = -d(div v)/dt: what div acc must then be.
State converging(double rate, double growth) {
  State a;
  a.strain = expanding(-rate);
  a.div_acc = terms::stretching(a.strain) - growth;
  a.alpha_v = 0;
  return a;
}

// Criterion: for v = A(t) x the acceleration is (dA/dt + A^2) x: steady A gives no viscosity, whatever A; to 1e-15.
TEST(Switches, CullenDehnenLeavesSteadyCompressionAndShearAlone) {
  const terms::SwitchCullenDehnen rule{};
  EXPECT_NEAR(next(rule, converging(5, 0), 1e-3), 0, 1e-15);
  EXPECT_NEAR(next(rule, converging(5, -100), 1e-3), 0, 1e-15);  // compression that lets up
  State shear;
  shear.strain = shearing(40);
  shear.div_acc = -1e4;
  shear.alpha_v = 0;
  EXPECT_EQ(next(rule, shear, 1e-3), 0);
}

// Criterion: alpha_loc by hand to 1e-3 (the limiter is 1 within that); it rises with the growth, up to alpha_max; a
// particle jumps to it at once.
TEST(Switches, CullenDehnenJumpsWhereConvergenceGrows) {
  const terms::SwitchCullenDehnen rule{};
  const double shock = sq(H) * 1000;
  EXPECT_NEAR(next(rule, converging(5, 1000), 1e-9), 2 * shock / (4 + shock), 2e-3);
  double before = 0;
  for (const double growth : {1.0, 10.0, 1e3, 1e5, 1e8}) {
    const double alpha = next(rule, converging(5, growth), 1e-9);
    EXPECT_GT(alpha, before);
    EXPECT_LE(alpha, rule.alpha_max);
    before = alpha;
  }
  EXPECT_NEAR(before, rule.alpha_max, 1e-3);
}

// Criterion: it falls with the time H/(2 l v_sig), to 1e-12, and no lower than what the flow asks for.
TEST(Switches, CullenDehnenDecaysSlowly) {
  const terms::SwitchCullenDehnen rule{};
  State a = converging(5, 0);
  a.alpha_v = 1;
  const double tau = H / (2 * rule.l * a.v_signal);
  EXPECT_NEAR(next(rule, a, tau), std::exp(-1.0), 1e-12);
  EXPECT_NEAR(next(rule, a, 1e6), 0, 1e-12);
  State steady = converging(5, 1000);
  steady.alpha_v = 1.9;
  const double goal = rule.wanted<2>(steady, SwitchStep{0, h, H});
  EXPECT_GT(goal, 0.1);
  EXPECT_NEAR(next(rule, steady, 1e6), goal, 1e-12);
}

}  // namespace
}  // namespace undine
