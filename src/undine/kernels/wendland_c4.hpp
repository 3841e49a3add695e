#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Wendland C4. Wendland (1995); Dehnen & Aly (2012), table 1.
///   W = alpha (1-R)^6 (35/3 R^2 + 6R + 1); in 1-D alpha (1-R)^5 (8R^2 + 5R + 1)
struct WendlandC4 {
  static constexpr Info info{"wendland_c4", "Wendland C4",
                             "W = alpha (1-R)^6 (35/3 R^2 + 6R + 1), alpha = 9/(pi H^2), 495/(32 pi H^3); "
                             "in 1-D alpha (1-R)^5 (8R^2 + 5R + 1), alpha = 3/(2 H)",
                             "Wendland (1995); Dehnen & Aly (2012), table 1"};
  static constexpr double natural_kappa = 2;
  static constexpr int smoothness = 4;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(3.0 / 2, 9 / pi, 495 / (32 * pi));
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return sq(sq(u)) * u * ((V(8) * R + V(5)) * R + V(1));
    else
      return cube(sq(u)) * ((V(35.0 / 3) * R + V(6)) * R + V(1));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return sq(sq(u)) * (V(-56) * R - V(14));
    else
      return sq(sq(u)) * u * (V(-280.0 / 3) * R - V(56.0 / 3));
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return V(14) * cube(u) * ((V(24) * R - V(3)) * R - V(1));
    else
      return V(56.0 / 3) * sq(sq(u)) * ((V(35) * R - V(4)) * R - V(1));
  }
};

}  // namespace undine
