#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// Generalised finite differences. Liszka & Orkisz (1980); Benito, Urena & Gavete (2001). At a point i,
/// d_j = x_j - x_i:
///   grad u, grad grad u minimise sum_j W_j^2 (u_i - u_j + d_j.grad u + d_j.grad grad u.d_j/2)^2
/// Elsewhere i is the nearest point, and its Taylor series is followed to x.
struct FiniteDifferences : Method {
  static constexpr Info info{
      "finite_differences", "Generalised finite differences",
      "grad u, grad grad u minimise sum_j W_j^2 (u_i - u_j + d_j.grad u + d_j.grad grad u.d_j/2)^2",
      "Liszka & Orkisz (1980); Benito, Urena & Gavete (2001)"};
  static constexpr int lowest_order = 1, highest_order = 2;
  static constexpr bool about_a_point = true;
  static constexpr Degrees reproduces(int order) { return {order, order, order == 2 ? 2 : Degrees::not_given}; }
  static constexpr int least_points(int N, int order) { return terms(N, order); }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
