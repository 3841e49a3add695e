#pragma once
#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// SPH's difference gradient with the kernel gradient corrected. Randles & Libersky (1996); Bonet & Lok (1999). At a
/// point i:
///   grad u = sum_j V_j (u_j - u_i) L grad W_j,  L^-1 = sum_j V_j grad W_j (x) (x_j - x_i)
/// Elsewhere i is the nearest point, and u(x) = u_i + (x - x_i).grad u.
struct CorrectedGradient : Method {
  static constexpr Info info{"corrected_gradient", "Kernel gradient correction",
                             "grad u = sum_j V_j (u_j - u_i) L grad W_j, L^-1 = sum_j V_j grad W_j (x) (x_j - x_i)",
                             "Randles & Libersky (1996); Bonet & Lok (1999)"};
  static constexpr int lowest_order = 1, highest_order = 1;
  static constexpr bool needs_volumes = true;
  static constexpr bool about_a_point = true;
  static constexpr Degrees reproduces(int) { return {1, 1, Degrees::not_given}; }
  static constexpr int least_points(int N, int) { return N + 1; }

  template <int N>
  static void weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out);
};

}  // namespace undine::approximation
