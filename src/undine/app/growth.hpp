#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace undine {

/// The power p of y ~ x^p: the slope of log y over log x by least squares. Not a number where there is none: fewer than
/// two different x, or a value that has no logarithm.
inline double growth_exponent(std::span<const double> x, std::span<const double> y) {
  const double n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, covariance = 0, variance = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean_x += std::log(x[k]) / n;
    mean_y += std::log(y[k]) / n;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    covariance += (std::log(x[k]) - mean_x) * (std::log(y[k]) - mean_y);
    variance += (std::log(x[k]) - mean_x) * (std::log(x[k]) - mean_x);
  }
  const double slope = covariance / variance;
  return x.size() > 1 && variance > 0 && std::isfinite(slope) ? slope : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace undine
