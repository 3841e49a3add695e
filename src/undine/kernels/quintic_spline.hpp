#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Quintic spline M6. Morris (1996); Niedoba (2012), eq. 2.42.
///   W = alpha 81/22 ( (1-R)+^5 - 6 (2/3-R)+^5 + 15 (1/3-R)+^5 ),  (x)+ = max(0, x)
struct QuinticSpline {
  static constexpr Info info{"quintic_spline", "Quintic spline (M6)",
                             "W = alpha (81/22 (1-R)^5 - 1/11 (2-3R)^5 [R<2/3] + 5/22 (1-3R)^5 [R<1/3]); "
                             "alpha = 33/(20 H), 2079/(239 pi H^2), 297/(20 pi H^3)",
                             "Morris (1996); Niedoba (2012), eq. 2.42"};
  static constexpr double natural_kappa = 3;
  static constexpr int smoothness = 4;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(33.0 / 20, 2079 / (239 * pi), 297 / (20 * pi));
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    const V a = kernel_parts::below(1, R);
    const V b = kernel_parts::below(2.0 / 3, R);
    const V c = kernel_parts::below(1.0 / 3, R);
    return V(81.0 / 22) * (sq(sq(a)) * a - V(6) * (sq(sq(b)) * b) + V(15) * (sq(sq(c)) * c));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    const V third = V(1.0 / 3);
    const V a = sq(kernel_parts::below(1, R));
    const V b = sq(kernel_parts::below(2.0 / 3, R));
    const V inner = (V(1620.0 / 11) - V(2025.0 / 11) * R) * sq(R) - V(180.0 / 11);
    const V outer = V(405.0 / 22) * (V(6) * sq(b) - sq(a)) / max(R, third);
    return select(R < third, inner, outer);
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    const V a = kernel_parts::below(1, R);
    const V b = kernel_parts::below(2.0 / 3, R);
    const V c = kernel_parts::below(1.0 / 3, R);
    return V(810.0 / 11) * (cube(a) - V(6) * cube(b) + V(15) * cube(c));
  }
};

}  // namespace undine
