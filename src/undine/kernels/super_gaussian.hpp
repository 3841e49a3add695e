#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Super Gaussian, truncated at R = 1, that is at 3 h. Monaghan (1992), after Gingold & Monaghan (1982).
///   W = alpha (N/2 + 1 - 9 R^2) exp(-9 R^2);  the full kernel has no second moment: it interpolates to fourth order
/// Negative for R^2 > (N/2 + 1)/9. alpha is that of the full kernel; the truncated integral misses 1 by `norm_defect`.
struct SuperGaussian {
  static constexpr Info info{
      "super_gaussian", "Super Gaussian, truncated at 3 h",
      "W = alpha (N/2 + 1 - 9 R^2) exp(-9 R^2) for R < 1; alpha = 3/(sqrt(pi) H), 9/(pi H^2), 27/(pi^(3/2) H^3); "
      "its integral is 1 + 1.9e-4, 1 + 9.9e-4, 1 + 3.3e-3; negative outside",
      "Gingold & Monaghan (1982); Monaghan (1992)"};
  static constexpr double natural_kappa = 3;
  static constexpr int smoothness = -1;
  static constexpr bool positive = false;
  static constexpr bool monotone = false;
  static constexpr bool exactly_normalised = false;

  template <int N>
  static constexpr double alpha() {
    using namespace kernel_parts;
    return by_dimension<N>(3 / sqrt_pi, 9 / pi, 27 / (pi * sqrt_pi));
  }
  /// The integral of W less 1: 3/sqrt(pi) exp(-9) - erfc(3), 8 exp(-9), 48/sqrt(pi) exp(-9) - erfc(3)
  /// = 1.868e-4, 9.873e-4, 3.320e-3.
  template <int N>
  static constexpr double norm_defect() {
    using namespace kernel_parts;
    return by_dimension<N>(erf_3 - 1 + 3 / sqrt_pi * exp_minus_9, 8 * exp_minus_9,
                           erf_3 - 1 + 48 / sqrt_pi * exp_minus_9);
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    return (V(N / 2.0 + 1) - V(9) * sq(R)) * bell(R);
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    return (V(162) * sq(R) - V(9 * N + 36)) * bell(R);
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    const V R2 = sq(R);
    return ((V(162 * N + 1134) - V(2916) * R2) * R2 - V(9 * N + 36)) * bell(R);
  }

 private:
  template <class V>
  static constexpr V bell(const V& R) {
    return select(R < V(1), exp(V(-9) * sq(R)), V(0));
  }
};

}  // namespace undine
