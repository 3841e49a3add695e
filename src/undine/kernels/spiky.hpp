#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Spiky kernel of Desbrun & Gascuel (1996), Mueller et al. (2003); Saalfeld (2012), eq. 64-66. Made for pressure: its
/// slope does not vanish towards R = 0. There it has a kink.
///   W = alpha (1-R)^3;  laplacian W = 90/(pi H^6) (H-r) (2 - H/r) for N = 3 (eq. 66 prints the opposite sign)
struct Spiky {
  static constexpr Info info{"spiky", "Spiky (Desbrun)", "W = alpha (1-R)^3; alpha = 2/H, 10/(pi H^2), 15/(pi H^3)",
                             "Desbrun & Gascuel (1996); Saalfeld (2012), eq. 64-66"};
  static constexpr double natural_kappa = 1;
  static constexpr int smoothness = 0;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(2, 10 / pi, 15 / pi);
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    return cube(kernel_parts::below(1, R));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return V(-3) * sq(kernel_parts::below(1, R));
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    return slope<N>(R) / kernel_parts::away_from_zero(R);
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    return V(6) * kernel_parts::below(1, R);
  }
};

}  // namespace undine
