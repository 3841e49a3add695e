#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Lucy's bell. Lucy (1977); in 1-D the same as Wendland C2. Lucy writes R = r/h; kappa = 2 here makes h
/// comparable.
///   W = alpha (1-R)^3 (3R+1)
struct Lucy {
  static constexpr Info info{"lucy", "Lucy's bell",
                             "W = alpha (1-R)^3 (3R+1); alpha = 5/(4 H), 5/(pi H^2), 105/(16 pi H^3)", "Lucy (1977)"};
  static constexpr double natural_kappa = 2;
  static constexpr int smoothness = 2;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(5.0 / 4, 5 / pi, 105 / (16 * pi));
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    return cube(kernel_parts::below(1, R)) * (V(3) * R + V(1));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    return V(-12) * sq(kernel_parts::below(1, R));
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    return kernel_parts::below(1, R) * (V(36) * R - V(12));
  }
};

}  // namespace undine
