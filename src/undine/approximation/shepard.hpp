#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// The kernel estimate over that of 1. Shepard (1968); Niedoba (2012), eq. 2.58. Derivatives are those of the quotient:
///   phi_j = V_j W_j/S,  grad phi_j = (V_j grad W_j - phi_j grad S)/S,  S = sum_k V_k W_k
struct Shepard : Method {
  static constexpr Info info{"shepard", "Kernel estimate over that of 1",
                             "u = sum_j V_j u_j W_j / sum_j V_j W_j; derivatives of the quotient",
                             "Shepard (1968); Niedoba (2012), eq. 2.58"};
  static constexpr int lowest_order = 0, highest_order = 0;
  static constexpr bool needs_volumes = true;
  static constexpr bool differentiates_kernel_twice = true;
  static constexpr Degrees reproduces(int) { return {0, 0, 0}; }
  static constexpr int least_points(int, int) { return 1; }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
