#pragma once
#include "undine/core/error.hpp"
#include "undine/integrators/step_control.hpp"
#include "undine/integrators/tableaux.hpp"

namespace undine::integrators {

// The moves that Runge-Kutta integrators need besides evaluate(), book() and smooth() (euler.hpp lists those):
//   start_stages(n)  keeps the state, makes room for n slopes
//   take_slope(k)    keeps the rates at hand as slope k
//   stage(w)         the state of the start plus sum_j w_j slope_j, w in seconds; time goes along by the sum of w
//   finish(w)        the same as the end of a step, which walls see: paths are reflected and booked
//   stage_error(w)   size of sum_j w_j slope_j, relative
//   reject()         the state, the time and the accounts of the start, and its rates
//   step_control()   the memory of a controller

/// dt times the first n coefficients.
template <int n, int room>
constexpr std::array<double, n> weights(const double (&coefficients)[room], double dt) {
  static_assert(n <= room);
  std::array<double, n> scaled{};
  for (int k = 0; k < n; ++k) scaled[k] = dt * coefficients[k];
  return scaled;
}

/// The stages of a step, up to the new state and its rates. Powers are booked with the weights of the rates, so the
/// accounts are of the same order as the state.
template <class Tableau, class Flow>
void run_stages(Flow& flow, double dt, int slopes) {
  flow.start_stages(slopes);
  for (int k = 0; k < Tableau::stages; ++k) {
    if (k > 0) {
      flow.stage(weights<Tableau::stages>(Tableau::a[k], dt));
      flow.evaluate();
    }
    flow.take_slope(k);
    flow.book(dt * Tableau::b[k]);
  }
  flow.finish(weights<Tableau::stages>(Tableau::b, dt));
  flow.evaluate();
}

template <class Tableau>
struct RungeKutta {
  using Coefficients = Tableau;
  static constexpr Info info = Tableau::info;
  static constexpr int order = Tableau::order;

  template <class Flow>
  static void step(Flow& flow, double dt) {
    run_stages<Tableau>(flow, dt, Tableau::stages);
    flow.smooth();
  }
};

/// An embedded pair: a step whose error is above the tolerance of the flow's control is taken again, shorter; so is one
/// that broke down. With a control that does not adapt it is a Runge-Kutta scheme like others.
template <class Tableau>
struct EmbeddedPair {
  using Coefficients = Tableau;
  static constexpr Info info = Tableau::info;
  static constexpr int order = Tableau::order;
  static constexpr bool adapts = true;
  static constexpr int most_trials = 12;

  template <class Flow>
  static void step(Flow& flow, double dt) {
    auto& control = flow.step_control();
    for (int trial = 1;; ++trial) {
      const double error = attempt(flow, dt, trial);
      if (error <= 1) {
        control.accept(dt, error, order, trial > 1);
        break;
      }
      if (trial == most_trials)
        throw RunError({.what = "no step is short enough for the tolerance",
                        .why = "twelve in a row missed it, each shorter than the one before",
                        .fix = "raise time.tolerance; below 1e-10 rounding alone can be larger"});
      dt = control.shorter(dt, error, order);
      flow.reject();
    }
    flow.smooth();
  }

 private:
  /// The error of a step in units of the tolerance.
  template <class Flow>
  static double attempt(Flow& flow, double dt, int trial) {
    const auto& control = flow.step_control();
    try {
      run_stages<Tableau>(flow, dt, Tableau::stages + 1);
      if (!control.adapts()) return 0;
      flow.take_slope(Tableau::stages);
      const double error = flow.stage_error(weights<Tableau::stages + 1>(Tableau::error, dt)) / control.tolerance;
      return std::isfinite(error) ? error : std::numeric_limits<double>::max();
    } catch (const RunError&) {
      if (!control.adapts() || trial == most_trials) throw;
      return std::numeric_limits<double>::max();
    }
  }
};

}  // namespace undine::integrators
