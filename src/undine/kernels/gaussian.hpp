#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Gaussian, truncated at R = 1, that is at 3 h. Gingold & Monaghan (1977); Niedoba (2012), eq. 2.43.
///   W = alpha exp(-9 R^2);  it jumps by alpha exp(-9) at R = 1
/// alpha is that of the full Gaussian, so that the integral of W misses 1 by `norm_defect`; `gaussian_corrected` does
/// not.
struct Gaussian {
  static constexpr Info info{"gaussian", "Gaussian, truncated at 3 h",
                             "W = alpha exp(-9 R^2) for R < 1; alpha = 3/(sqrt(pi) H), 9/(pi H^2), 27/(pi^(3/2) H^3); "
                             "its integral is 1 - 2.2e-5, 1 - 1.2e-4, 1 - 4.4e-4",
                             "Gingold & Monaghan (1977); Niedoba (2012), eq. 2.43"};
  static constexpr double natural_kappa = 3;
  static constexpr int smoothness = -1;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = false;

  template <int N>
  static constexpr double alpha() {
    using namespace kernel_parts;
    return by_dimension<N>(3 / sqrt_pi, 9 / pi, 27 / (pi * sqrt_pi));
  }
  /// The integral of W less 1: -erfc(3), -exp(-9), -erfc(3) - 6/sqrt(pi) exp(-9)
  /// = -2.209e-5, -1.234e-4, -4.398e-4.
  template <int N>
  static constexpr double norm_defect() {
    using namespace kernel_parts;
    return by_dimension<N>(erf_3 - 1, -exp_minus_9, erf_3 - 1 - 6 / sqrt_pi * exp_minus_9);
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    return select(R < V(1), exp(V(-9) * sq(R)), V(0));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    return V(-18) * shape<N>(R);
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    return (V(324) * sq(R) - V(18)) * shape<N>(R);
  }
};

}  // namespace undine
