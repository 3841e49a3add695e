#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace undine::integrators {

/// The step of an embedded pair, from the errors of this step and the one before (a PI controller). Gustafsson (1991);
/// Hairer, Norsett & Wanner (1993), eq. II.4.13, and Hairer & Wanner (1996), eq. IV.2.43: with errors in units of the
/// tolerance and k one more than the order of the estimate,
///   dt_next = 0.9 dt error^(-0.7/k) error_before^(0.4/k).
struct StepControl {
  double tolerance = std::numeric_limits<double>::infinity();  ///< of `stage_error`; infinite: steps as they are given
  double proposed = 0;                                         ///< the next step, s; 0: none yet
  double error_before = 1;
  long rejected = 0;

  static constexpr double safety = 0.9, smallest_factor = 0.2, largest_factor = 5;

  bool adapts() const { return std::isfinite(tolerance); }

  /// Takes note of a step that was good; after one that had to be repeated it does not grow.
  void accept(double dt, double error, int k, bool repeated) {
    if (!adapts()) return;
    const double now = std::max(error, 1e-4);
    const double factor = safety * std::pow(now, -0.7 / k) * std::pow(error_before, 0.4 / k);
    proposed = dt * std::clamp(factor, smallest_factor, repeated ? 1 : largest_factor);
    error_before = now;
  }
  /// The step to try instead of one whose error was above 1.
  double shorter(double dt, double error, int k) {
    ++rejected;
    return dt * std::max(smallest_factor, safety * std::pow(error, -1.0 / k));
  }
};

}  // namespace undine::integrators
