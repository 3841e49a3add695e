#pragma once
#include "undine/kernels/parts.hpp"

namespace undine {

/// Quartic function of Liu (2002); Niedoba (2012), eq. 2.41.
///   W = alpha (1-R)^2 (2/3 + 4/3 R - 5/2 R^2),  the same polynomial factored
/// Though often said to be positive, it is negative for R > (4 + sqrt(76))/15 = 0.848 and rises again from R = 0.9 on.
struct QuarticLiu {
  static constexpr Info info{
      "quartic", "Quartic (Liu)",
      "W = alpha (2/3 - 9/2 R^2 + 19/3 R^3 - 5/2 R^4); alpha = 2/H, 60/(7 pi H^2), 315/(26 pi H^3); "
      "slightly negative for R > 0.848",
      "Liu (2002); Niedoba (2012), eq. 2.41"};
  static constexpr double natural_kappa = 2;
  static constexpr int smoothness = 1;
  static constexpr bool positive = false;
  static constexpr bool monotone = false;
  static constexpr bool exactly_normalised = true;

  template <int N>
  static constexpr double alpha() {
    using kernel_parts::pi;
    return kernel_parts::by_dimension<N>(2, 60 / (7 * pi), 315 / (26 * pi));
  }
  template <int N, class V>
  static constexpr V shape(const V& R) {
    const V u = kernel_parts::below(1, R);
    return sq(u) * ((V(4.0 / 3) - V(2.5) * R) * R + V(2.0 / 3));
  }
  template <int N, class V>
  static constexpr V slope(const V& R) {
    return slope_over_R<N>(R) * R;
  }
  template <int N, class V>
  static constexpr V slope_over_R(const V& R) {
    const V u = kernel_parts::below(1, R);
    return u * (V(10) * R - V(9));
  }
  template <int N, class V>
  static constexpr V curvature(const V& R) {
    return select(R < V(1), (V(38) - V(30) * R) * R - V(9), V(0));
  }
};

}  // namespace undine
