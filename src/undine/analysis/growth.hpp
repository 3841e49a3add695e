#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace undine {

/// Slope of the straight line through (x, y) by least squares. Not a number where there is none: fewer than two
/// different x, or a value that is not finite.
inline double slope(std::span<const double> x, std::span<const double> y) {
  const double n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean_x += x[k] / n;
    mean_y += y[k] / n;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mean_x) * (x[k] - mean_x);
    xy += (x[k] - mean_x) * (y[k] - mean_y);
  }
  return x.size() > 1 && xx > 0 && std::isfinite(xy / xx) ? xy / xx : std::numeric_limits<double>::quiet_NaN();
}

/// The power p of y ~ x^p, by the slope of log y over log x: how a cost grows with n, or, of errors over spacings, the
/// observed order. Not a number where there is none: fewer than two different x, or a value that has no logarithm.
inline double growth_exponent(std::span<const double> x, std::span<const double> y) {
  std::vector<double> log_x, log_y;
  for (const double value : x) log_x.push_back(std::log(value));
  for (const double value : y) log_y.push_back(std::log(value));
  return slope(log_x, log_y);
}

}  // namespace undine
