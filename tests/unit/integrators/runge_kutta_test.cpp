#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "undine/integrators/catalogue.hpp"

// The recipes of Runge-Kutta on a system small enough to know: a damped pendulum with a density that follows it, by the
// same moves as a flow's. Orders on particles: tests/unit/schemes/order_test.cpp.

namespace undine {
namespace {

using integrators::StepControl;

/// x'' = -sin x - 0.2 x', rho' = -rho x' cos x, which is rho = exp(-sin x) up to a factor; damping books what it takes.
struct Pendulum {
  static constexpr double damping = 0.2;
  struct State {
    double t = 0, x = 1.5, v = 0.3, rho = 1;
  };
  using Slope = State;  // t' = 1

  State now, start;
  Slope rate;
  std::vector<Slope> slopes;
  double booked = 0, booked_start = 0;
  int evaluations = 0;
  StepControl control;

  Pendulum() { evaluate(); }
  void evaluate() {
    ++evaluations;
    rate = {1, now.v, -std::sin(now.x) - damping * now.v, -now.rho * now.v * std::cos(now.x)};
  }
  void book(double dt) { booked += dt * damping * now.v * now.v; }
  void smooth() {}
  void start_stages(int count) {
    start = now;
    booked_start = booked;
    slopes.assign(static_cast<std::size_t>(count), {});
  }
  void take_slope(int k) { slopes[static_cast<std::size_t>(k)] = rate; }
  State combined(State from, std::span<const double> w) const {
    for (std::size_t k = 0; k < w.size(); ++k) {
      from.t += w[k] * slopes[k].t;
      from.x += w[k] * slopes[k].x;
      from.v += w[k] * slopes[k].v;
      from.rho += w[k] * slopes[k].rho;
    }
    return from;
  }
  void stage(std::span<const double> w) { now = combined(start, w); }
  void finish(std::span<const double> w) { now = combined(start, w); }
  double stage_error(std::span<const double> w) const {
    const State difference = combined({0, 0, 0, 0}, w);
    return std::hypot(difference.v, difference.rho);
  }
  void reject() {
    now = start;
    booked = booked_start;
    evaluate();
  }
  StepControl& step_control() { return control; }

  double energy() const { return 0.5 * now.v * now.v - std::cos(now.x) + booked; }
};

template <class Integrator>
Pendulum after(int steps, double end = 1) {
  Pendulum pendulum;
  for (int k = 0; k < steps; ++k) Integrator::step(pendulum, end / steps);
  return pendulum;
}

double distance(const Pendulum& a, const Pendulum& b) {
  return std::hypot(a.now.x - b.now.x, a.now.v - b.now.v, a.now.rho - b.now.rho);
}

template <class F>
void for_each_runge_kutta(F f) {
  integrators::Integrators::for_each([&]<class Integrator>(Integrator) {
    if constexpr (requires { typename Integrator::Coefficients; }) f(Integrator{});
  });
}

// Criterion: over two or three halvings of the step the errors of state and of booked energy fall with at least the
// order that the integrator says, less 0.2; that of the state with no more than 0.2 above it for orders up to 4. (The
// fifth order's leading error happens to be small here.)
TEST(RungeKutta, HasItsOrderInStateAndAccounts) {
  using Reference = integrators::EmbeddedPair<integrators::DormandPrince>;
  const Pendulum exact = after<Reference>(2000);
  int seen = 0;
  for_each_runge_kutta([&]<class Integrator>(Integrator) {
    const int steps = Integrator::order > 3 ? 16 : 80;
    const int halvings = Integrator::order > 4 ? 2 : 3;  // rounding ends what the fifth order gains by more
    const Pendulum coarse = after<Integrator>(steps), fine = after<Integrator>(steps << halvings);
    const double order = std::log2(distance(coarse, exact) / distance(fine, exact)) / halvings;
    const double accounts =
        std::log2(std::abs((coarse.energy() - exact.energy()) / (fine.energy() - exact.energy()))) / halvings;
    EXPECT_GE(order, Integrator::order - 0.2) << Integrator::info.name;
    EXPECT_GE(accounts, Integrator::order - 0.2) << Integrator::info.name;
    if (Integrator::order <= 4) {
      EXPECT_LE(order, Integrator::order + 0.2) << Integrator::info.name;
    }
    EXPECT_NEAR(fine.now.t, 1, 1e-13);
    std::printf("    %s: order %.3f, accounts %.3f\n", Integrator::info.name.data(), order, accounts);
    ++seen;
  });
  EXPECT_EQ(seen, 5);
}

// Criterion: rows sum to what the order conditions up to 3 ask for, to 1e-15, and weights of the error sum to zero.
template <class Tableau>
void check_conditions() {
  double sum = 0, first = 0, second = 0;
  for (int k = 0; k < Tableau::stages; ++k) {
    const double c = std::accumulate(Tableau::a[k], Tableau::a[k] + Tableau::stages, 0.0);
    sum += Tableau::b[k], first += Tableau::b[k] * c, second += Tableau::b[k] * c * c;
  }
  EXPECT_NEAR(sum, 1, 1e-15) << Tableau::info.name;
  EXPECT_NEAR(first, 1.0 / 2, 1e-15) << Tableau::info.name;
  if constexpr (Tableau::order >= 3) {
    EXPECT_NEAR(second, 1.0 / 3, 1e-15) << Tableau::info.name;
  }
  if constexpr (requires { Tableau::error; }) {
    EXPECT_NEAR(std::accumulate(std::begin(Tableau::error), std::end(Tableau::error), 0.0), 0, 1e-15);
  }
}
TEST(RungeKutta, CoefficientsMeetTheOrderConditions) {
  for_each_runge_kutta([]<class Integrator>(Integrator) { check_conditions<typename Integrator::Coefficients>(); });
}

/// A run with steps by the error, from a first step that is far too long.
template <class Integrator>
Pendulum adaptive(double tolerance) {
  Pendulum pendulum;
  pendulum.control.tolerance = tolerance;
  double dt = 1;
  while (pendulum.now.t < 10) {
    Integrator::step(pendulum, dt);
    dt = std::min(pendulum.control.proposed, 10 - pendulum.now.t);
    if (10 - pendulum.now.t < 1e-12) break;
  }
  return pendulum;
}

template <class F>
void for_each_pair(F f) {
  f(integrators::EmbeddedPair<integrators::BogackiShampine>{});
  f(integrators::EmbeddedPair<integrators::DormandPrince>{});
}

// Criterion: the error after 10 s is within a factor of 30 of the tolerance, falls with it, and the accounts close to
// the same; a smaller tolerance costs more evaluations, fewer with the higher order.
TEST(RungeKutta, EmbeddedPairsMeetTheirTolerance) {
  using Best = integrators::EmbeddedPair<integrators::DormandPrince>;
  const Pendulum exact = after<Best>(20000, 10);
  int evaluations_at_tight[2] = {}, which = 0;
  for_each_pair([&]<class Pair>(Pair) {
    double error_before = 1;
    int evaluations_before = 0;
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      const Pendulum end = adaptive<Pair>(tolerance);
      const double error = distance(end, exact);
      std::printf("    %s, tolerance %.0e: error %.2g, %d evaluations, %ld steps repeated\n", Pair::info.name.data(),
                  tolerance, error, end.evaluations, end.control.rejected);
      EXPECT_NEAR(end.now.t, 10, 1e-9);
      EXPECT_LE(error, 30 * tolerance) << Pair::info.name;
      EXPECT_LE(std::abs(end.energy() - exact.energy()), 30 * tolerance) << Pair::info.name;
      EXPECT_LT(error, error_before / 5) << Pair::info.name;
      EXPECT_GT(end.evaluations, evaluations_before) << Pair::info.name;
      error_before = error, evaluations_before = end.evaluations;
    }
    evaluations_at_tight[which++] = evaluations_before;
  });
  EXPECT_LT(evaluations_at_tight[1], evaluations_at_tight[0]);
}

// Criterion: a step that is far too long is taken again, and ends in the state that the shorter step gives, to 1e-15
// (its length is known to rounding only).
TEST(RungeKutta, ARejectedStepLeavesNoTrace) {
  for_each_pair([]<class Pair>(Pair) {
    Pendulum tried;
    tried.control.tolerance = 1e-8;
    Pair::step(tried, 3);
    EXPECT_GT(tried.control.rejected, 0);
    Pendulum straight;
    Pair::step(straight, tried.now.t);
    EXPECT_EQ(straight.now.t, tried.now.t);
    EXPECT_NEAR(straight.now.x, tried.now.x, 1e-15);
    EXPECT_NEAR(straight.now.v, tried.now.v, 1e-15);
    EXPECT_NEAR(straight.booked, tried.booked, 1e-15);
    EXPECT_LE(tried.control.proposed, tried.now.t);  // no growth after a step that had to be repeated
  });
}

/// Breaks down where the angle is large.
struct Brittle : Pendulum {
  void evaluate() {
    Pendulum::evaluate();
    if (std::abs(now.x) > 1.9) throw RunError({.what = "broken"});
  }
};

// Criterion: a step that broke down is repeated shorter; without a tolerance the error passes through.
TEST(RungeKutta, AStepThatBreaksDownIsTakenAgainShorter) {
  for_each_pair([]<class Pair>(Pair) {
    Brittle careful;
    careful.control.tolerance = 1e-3;
    Pair::step(careful, 30);
    EXPECT_GT(careful.control.rejected, 0);
    EXPECT_LT(careful.now.t, 30);
    Brittle plain;
    EXPECT_THROW(Pair::step(plain, 30), RunError);
  });
}

// Criterion: an error that no step brings down ends the run with advice.
TEST(RungeKutta, AToleranceThatCannotBeMetIsAnError) {
  Pendulum pendulum;
  pendulum.control.tolerance = 1e-300;
  EXPECT_THROW(integrators::EmbeddedPair<integrators::DormandPrince>::step(pendulum, 1), RunError);
}

// Criterion: steady errors at the tolerance leave a step by the safety factor; small errors let it grow by at most
// five, large ones shrink it by at most five.
TEST(RungeKutta, ControllerIsBounded) {
  StepControl control{.tolerance = 1};
  control.accept(0.1, 1, 3, false);
  EXPECT_NEAR(control.proposed, 0.09, 1e-15);
  control.accept(0.1, 0, 3, false);
  EXPECT_EQ(control.proposed, 0.5);
  control.accept(0.1, 0, 3, true);
  EXPECT_EQ(control.proposed, 0.1);
  EXPECT_NEAR(control.shorter(0.1, 1e30, 3), 0.02, 1e-15);
  EXPECT_NEAR(control.shorter(0.1, 8, 3), 0.045, 1e-15);
}

}  // namespace
}  // namespace undine
