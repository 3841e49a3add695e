#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Quadratic function of Johnson (1996); Niedoba (2012), eq. 2.44. Its slope grows towards R = 0, which keeps particles
/// from clumping, at the price of a kink there: its Laplacian has 1/R for N > 1.
///   W = alpha 3/4 (1-R)^2
struct Quadratic {
  static constexpr Info info{"quadratic", "Quadratic (Johnson)",
                             "W = alpha (3/4 - 3/2 R + 3/4 R^2); alpha = 2/H, 8/(pi H^2), 10/(pi H^3)",
                             "Johnson et al. (1996); Niedoba (2012), eq. 2.44"};
  static constexpr double natural_kappa = 2;
  static constexpr int smoothness = 0;
  static constexpr bool positive = true;
  static constexpr bool monotone = true;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(2, 8 / pi, 10 / pi);
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    return V(0.75) * sq(kernel_parts::below(1, R));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return V(-1.5) * kernel_parts::below(1, R);
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    return slope<N>(R) / kernel_parts::away_from_zero(R);
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    return select(R < V(1), V(1.5), V(0));
  }
};

}  // namespace undine
