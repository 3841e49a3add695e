#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// Corrective smoothed particle method. Chen, Beraun & Carney (1999), in N dimensions. At a point i, d_j
/// = x_j - x_i:
///   u = sum_j V_j u_j W_j / sum_j V_j W_j
///   sum_j V_j (u_j - u_i) grad W_j = (sum_j V_j grad W_j (x) d_j) grad u
///   sum_j V_j (u_j - u_i - d_j.grad u) grad grad W_j = sum_j V_j grad grad W_j (d_j.grad grad u.d_j)/2   (order 2)
/// Elsewhere i is the nearest point, and its Taylor series is followed to x. Second derivatives inherit the error of
/// the gradient: on disordered points they do not converge.
struct Cspm : Method {
  static constexpr Info info{"cspm", "Corrective smoothed particle method",
                             "u = Shepard; sum_j V_j (u_j - u_i) grad W_j = (sum_j V_j grad W_j (x) d_j) grad u; "
                             "order 2: the same with grad grad W_j for grad grad u",
                             "Chen, Beraun & Carney (1999)"};
  static constexpr int lowest_order = 1, highest_order = 2;
  static constexpr bool needs_volumes = true;
  static constexpr bool about_a_point = true;
  static constexpr Degrees reproduces(int order) { return {0, 1, order == 2 ? 1 : Degrees::not_given}; }
  static constexpr int least_points(int N, int order) { return terms(N, order); }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
