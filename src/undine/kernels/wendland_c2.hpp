#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Wendland C2. Wendland (1995); Saalfeld (2012), eq. 67-69; in 1-D Dehnen & Aly (2012), table 1.
///   W = alpha (1-R)^4 (4R+1), R = r/H; in 1-D alpha (1-R)^3 (3R+1)
struct WendlandC2 {
  static constexpr Info info{"wendland_c2", "Wendland C2",
                             "W = alpha (1-R)^4 (4R+1), alpha = 7/(pi H^2), 21/(2 pi H^3); "
                             "in 1-D alpha (1-R)^3 (3R+1), alpha = 5/(4 H)",
                             "Wendland (1995); Saalfeld (2012), eq. 67-69"};
  static constexpr double natural_kappa = 2;
  static constexpr int smoothness = 2;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(5.0 / 4, 7 / pi, 21 / (2 * pi));
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return cube(u) * (V(3) * R + V(1));
    else
      return sq(sq(u)) * (V(4) * R + V(1));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return V(-12) * sq(u);
    else
      return V(-20) * cube(u);
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return u * (V(36) * R - V(12));
    else
      return sq(u) * (V(80) * R - V(20));
  }
};

}  // namespace undine
