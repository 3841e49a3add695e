#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// Reproducing kernel particle method. W.K. Liu, Jun & Zhang (1995); Niedoba (2012), eq. 2.80-2.86, there in 1-D and of
/// first order; in N dimensions with p the polynomials up to the order:
///   u(x) = sum_j u_j C(x, x_j) W(x - x_j) V_j,  C(x, xi) = c(x).p(xi - x),  M(x) c(x) = p(0),
///   M(x) = sum_j p(x_j - x) p(x_j - x)^T W(x - x_j) V_j
/// Derivatives are those of this sum, C and W both.
struct Rkpm : Method {
  static constexpr Info info{"rkpm", "Reproducing kernel particle method",
                             "u = sum_j u_j C(x, x_j) W_j V_j, C = c.p(x_j - x), "
                             "(sum_j p p^T W_j V_j) c = p(0); derivatives of C and W",
                             "Liu, Jun & Zhang (1995); Niedoba (2012), eq. 2.80-2.86"};
  static constexpr int lowest_order = 0, highest_order = 2;
  static constexpr bool needs_volumes = true;
  static constexpr bool differentiates_kernel_twice = true;
  static constexpr Degrees reproduces(int order) { return {order, order, order}; }
  static constexpr int least_points(int N, int order) { return terms(N, order); }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
