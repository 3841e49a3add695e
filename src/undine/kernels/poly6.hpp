#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Poly6 of Mueller, Charypar & Gross (2003); Saalfeld (2012), eq. 61-63. Needs no square root: a function of R^2.
///   W = alpha (1-R^2)^3
struct Poly6 {
  static constexpr Info info{"poly6", "Poly6 (Mueller)",
                             "W = alpha (1-R^2)^3; alpha = 35/(32 H), 4/(pi H^2), 315/(64 pi H^3)",
                             "Mueller et al. (2003); Saalfeld (2012), eq. 61-63"};
  static constexpr double natural_kappa = 1;
  static constexpr int smoothness = 2;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(35.0 / 32, 4 / pi, 315 / (64 * pi));
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    return cube(kernel_parts::below(1, sq(R)));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    return V(-6) * sq(kernel_parts::below(1, sq(R)));
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    const V R2 = sq(R);
    return kernel_parts::below(1, R2) * (V(30) * R2 - V(6));
  }
};

}  // namespace undine
