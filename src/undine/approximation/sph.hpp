#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// The kernel estimate of SPH and its derivatives. Niedoba (2012), eq. 2.55 and 2.56; Monaghan (1992).
///   u(x) = sum_j V_j u_j W_j,  grad u = sum_j V_j u_j grad W_j,  grad grad u = sum_j V_j u_j grad grad W_j
struct Sph : Method {
  static constexpr Info info{"sph", "Kernel estimate of SPH",
                             "u = sum_j V_j u_j W_j, grad u = sum_j V_j u_j grad W_j, V = m/rho",
                             "Monaghan (1992); Niedoba (2012), eq. 2.55, 2.56"};
  static constexpr int lowest_order = 0, highest_order = 0;
  static constexpr bool needs_volumes = true;
  static constexpr bool differentiates_kernel_twice = true;
  static constexpr Degrees reproduces(int) { return {Degrees::none, Degrees::none, Degrees::none}; }
  static constexpr int least_points(int, int) { return 1; }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
