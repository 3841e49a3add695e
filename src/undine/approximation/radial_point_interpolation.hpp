#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// Radial point interpolation with polynomials. Wang & Liu (2002): multiquadrics
///   u(x) = sum_j a_j B(|x - x_j|) + p(x).c,  u(x_j) = u_j,  sum_j a_j p(x_j) = 0,
///   B(r) = (r^2 + (alpha_c d_c)^2)^q,  alpha_c = 1, q = 1.03
/// d_c, the distance of points, is that of as many points spread over the whole support. Passes through all data.
/// No kernel, no volumes; u(x) jumps a little where a point enters the support.
struct RadialPointInterpolation : Method {
  static constexpr Info info{"radial_point_interpolation",
                             "Point interpolation, radial (multiquadrics) with polynomials",
                             "u = sum_j a_j B(|x - x_j|) + p(x).c, u(x_j) = u_j, sum_j a_j p(x_j) = 0, "
                             "B = (r^2 + d_c^2)^1.03",
                             "Wang & Liu (2002)"};
  static constexpr double alpha_c = 1, q = 1.03;
  static constexpr int lowest_order = 0, highest_order = 2;
  static constexpr Degrees reproduces(int order) { return {order, order, order}; }
  static constexpr int least_points(int N, int order) { return terms(N, order); }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
