#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Quartic spline M5. Schoenberg (1946); Price (2012), J. Comput. Phys. 231, sec. 2 (with q = 5/2 R, here divided by
/// (5/2)^4).
///   W = alpha ( (1-R)+^4 - 5 (3/5-R)+^4 + 10 (1/5-R)+^4 ),  (x)+ = max(0, x);  for R < 1/5: 46/125 - 12/5 R^2 + 6 R^4
struct QuarticSpline {
  static constexpr Info info{"quartic_spline", "Quartic spline (M5)",
                             "W = alpha ((1-R)^4 - 5 (3/5-R)^4 [R<3/5] + 10 (1/5-R)^4 [R<1/5]); "
                             "alpha = 3125/(768 H), 46875/(2398 pi H^2), 15625/(512 pi H^3)",
                             "Schoenberg (1946); Price (2012)"};
  static constexpr double natural_kappa = 2.5;
  static constexpr int smoothness = 3;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(3125.0 / 768, 46875 / (2398 * pi), 15625 / (512 * pi));
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    const V a = sq(kernel_parts::below(1, R));
    const V b = sq(kernel_parts::below(0.6, R));
    const V c = sq(kernel_parts::below(0.2, R));
    return sq(a) - V(5) * sq(b) + V(10) * sq(c);
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    const V a = kernel_parts::below(1, R);
    const V b = kernel_parts::below(0.6, R);
    return select(R < V(0.2), V(24) * sq(R) - V(4.8), (V(20) * cube(b) - V(4) * cube(a)) / max(R, V(0.2)));
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    const V a = kernel_parts::below(1, R);
    const V b = kernel_parts::below(0.6, R);
    const V c = kernel_parts::below(0.2, R);
    return V(12) * sq(a) - V(60) * sq(b) + V(120) * sq(c);
  }
};

}  // namespace undine
