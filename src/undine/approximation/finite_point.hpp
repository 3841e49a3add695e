#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// Finite point method: weighted least squares with the weights held fixed. Onate, Idelsohn, Zienkiewicz & Taylor
/// (1996).
///   c minimises sum_j W_j (u_j - p(x_j - x).c)^2;  u, grad u and grad grad u are the coefficients of the polynomial
struct FinitePoint : Method {
  static constexpr Info info{"finite_point", "Finite point method (weighted least squares)",
                             "c minimises sum_j W_j (u_j - p(x_j - x).c)^2; derivatives of the polynomial alone",
                             "Onate, Idelsohn, Zienkiewicz & Taylor (1996)"};
  static constexpr int lowest_order = 1, highest_order = 2;
  static constexpr bool needs_positive_kernel = true;
  static constexpr Degrees reproduces(int order) { return {order, order, order == 2 ? 2 : Degrees::not_given}; }
  static constexpr int least_points(int N, int order) { return terms(N, order); }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
