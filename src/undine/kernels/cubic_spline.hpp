#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Cubic spline M4. Monaghan & Lattanzio (1985); Niedoba (2012), eq. 2.40.
///   both pieces in one: W = alpha 4/3 ( (1-R)+^3 - 4 (1/2-R)+^3 ),  (x)+ = max(0, x)
struct CubicSpline {
  static constexpr Info info{"cubic_spline", "Cubic spline (M4)",
                             "W = alpha (2/3 - 4 R^2 + 4 R^3) for R < 1/2, alpha 4/3 (1-R)^3 for R < 1; alpha = 2/H, "
                             "60/(7 pi H^2), 12/(pi H^3)",
                             "Monaghan & Lattanzio (1985); Niedoba (2012), eq. 2.40"};
  static constexpr double natural_kappa = 2;
  static constexpr int smoothness = 2;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(2, 60 / (7 * pi), 12 / pi);
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    const V u = kernel_parts::below(1, R);
    const V v = kernel_parts::below(0.5, R);
    return V(4.0 / 3) * (cube(u) - V(4) * cube(v));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    const V u = kernel_parts::below(1, R);
    const V v = kernel_parts::below(0.5, R);
    return V(16) * sq(v) - V(4) * sq(u);
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    const V u = kernel_parts::below(1, R);
    return select(R < V(0.5), V(12) * R - V(8), V(-4) * sq(u) / max(R, V(0.5)));
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    const V u = kernel_parts::below(1, R);
    const V v = kernel_parts::below(0.5, R);
    return V(8) * u - V(32) * v;
  }
};

}  // namespace undine
