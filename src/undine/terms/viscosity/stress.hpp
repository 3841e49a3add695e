#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

// The full Newtonian stress of a compressible fluid without bulk viscosity,
//   tau = mu epsilon,  epsilon = L + L^T - 2/3 tr(L) 1,  L_ij = d v_j/d x_i
// (Niedoba 2012, eq. 2.10 and 2.64; the trace term is 2/3 div v). Force and heat take the weights of Niedoba's two
// pressure forms, with the masses m_b that the print misses in the viscous sums. Heat is tau:L/rho, which is his
// mu/(2 rho) epsilon:epsilon: in 1-D and 2-D with the normal components across, which a flow in fewer dimensions has
// too. Written in the pair it takes exactly what the force takes from the motion.

/// epsilon of a velocity gradient L (field `strain`); symmetric, so either order of indices will do.
template <int N, class V>
constexpr Vec<N, Vec<N, V>> deviator(const Vec<N, Vec<N, V>>& L) {
  V trace = L[0][0];
  for (int k = 1; k < N; ++k) trace = trace + L[k][k];
  Vec<N, Vec<N, V>> epsilon;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) epsilon[i][j] = L[i][j] + L[j][i];
    epsilon[i][i] = epsilon[i][i] - 2.0 / 3 * trace;
  }
  return epsilon;
}

struct ViscousStressSum {
  static constexpr Info info{
      "stress_sum", "Newtonian stress in the weights of pressure form `sum`, with its heat; conserves energy",
      "dv_a/dt = sum_b m_b (tau_a + tau_b)/(rho_a rho_b) grad_a W_ab, de_a/dt = tau_a/rho_a : sum_b m_b/rho_b (v_b - "
      "v_a) grad_a W_ab",
      "Niedoba (2012), eq. 2.62, 2.64 and 2.65 (masses added)"};
  using reads = Fields<m, rho, v, stress>;
  using adds = Fields<acc, de>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto from_a = b.m / (a.rho * b.rho) * times(a.stress, ab.grad_w);
    const auto from_b = b.m / (a.rho * b.rho) * times(b.stress, ab.grad_w);
    return adds::row(from_a + from_b, dot(from_a, b.v - a.v));
  }
};

struct ViscousStressSymmetric {
  static constexpr Info info{
      "stress_symmetric",
      "Newtonian stress in the weights of pressure form `symmetric`, with its heat; conserves energy",
      "dv_a/dt = sum_b m_b (tau_a/rho_a^2 + tau_b/rho_b^2) grad_a W_ab, de_a/dt = tau_a/rho_a^2 : sum_b m_b (v_b - "
      "v_a) grad_a W_ab",
      "Niedoba (2012), eq. 2.63, 2.64 and 2.66 (masses added)"};
  using reads = Fields<m, rho, v, stress>;
  using adds = Fields<acc, de>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto from_a = b.m / sq(a.rho) * times(a.stress, ab.grad_w);
    const auto from_b = b.m / sq(b.rho) * times(b.stress, ab.grad_w);
    return adds::row(from_a + from_b, dot(from_a, b.v - a.v));
  }
};

}  // namespace undine::terms
