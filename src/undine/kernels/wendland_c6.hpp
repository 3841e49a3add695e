#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Wendland C6. Wendland (1995); Dehnen & Aly (2012), table 1.
///   W = alpha (1-R)^8 (32R^3 + 25R^2 + 8R + 1); in 1-D alpha (1-R)^7 (21R^3 + 19R^2 + 7R + 1)
struct WendlandC6 {
  static constexpr Info info{"wendland_c6", "Wendland C6",
                             "W = alpha (1-R)^8 (32R^3 + 25R^2 + 8R + 1), alpha = 78/(7 pi H^2), 1365/(64 pi H^3); "
                             "in 1-D alpha (1-R)^7 (21R^3 + 19R^2 + 7R + 1), alpha = 55/(32 H)",
                             "Wendland (1995); Dehnen & Aly (2012), table 1"};
  static constexpr double natural_kappa = 2;
  static constexpr int smoothness = 6;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(55.0 / 32, 78 / (7 * pi), 1365 / (64 * pi));
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return cube(sq(u)) * u * (((V(21) * R + V(19)) * R + V(7)) * R + V(1));
    else
      return sq(sq(sq(u))) * (((V(32) * R + V(25)) * R + V(8)) * R + V(1));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return V(-6) * cube(sq(u)) * ((V(35) * R + V(18)) * R + V(3));
    else
      return V(-22) * cube(sq(u)) * u * ((V(16) * R + V(7)) * R + V(1));
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    const V u = kernel_parts::below(1, R);
    if constexpr (N == 1)
      return V(18) * sq(sq(u)) * u * (((V(105) * R + V(13)) * R - V(5)) * R - V(1));
    else
      return V(22) * cube(sq(u)) * (((V(160) * R + V(15)) * R - V(6)) * R - V(1));
  }
};

}  // namespace undine
