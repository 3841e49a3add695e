#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// Moving least squares. Lancaster & Salkauskas (1981); Belytschko, Lu & Gu (1994).
///   u(x) = p(0).c(x),  c(x) minimises sum_j W(x - x_j) (u_j - p(x_j - x).c)^2
/// Derivatives are those of u(x), the weights included. Knows no volumes.
struct MovingLeastSquares : Method {
  static constexpr Info info{
      "mls", "Moving least squares",
      "u(x) = p(0).c(x), c(x) minimises sum_j W_j (u_j - p(x_j - x).c)^2; derivatives of c and W",
      "Lancaster & Salkauskas (1981); Belytschko, Lu & Gu (1994)"};
  static constexpr int lowest_order = 0, highest_order = 2;
  static constexpr bool needs_positive_kernel = true;
  static constexpr bool differentiates_kernel_twice = true;
  static constexpr Degrees reproduces(int order) { return {order, order, order}; }
  static constexpr int least_points(int N, int order) { return terms(N, order); }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
