#pragma once
#include <Eigen/LU>

#include "undine/approximation/fixed_fit.hpp"
#include "undine/approximation/neighbourhood.hpp"

namespace undine::approximation {

/// The weights of a gradient about the centre, from the equations
///   sum_j V_j (u_j - u_c) grad W_j = (sum_j V_j grad W_j (x) s_j) grad u
/// in out.gradient; the condition number of the bracket in out.condition.
template <int N>
void corrected_gradient(const Neighbourhood<N>& around, Stencil<N>& out) {
  Eigen::Matrix<double, N, N> B = Eigen::Matrix<double, N, N>::Zero();
  for (std::size_t j = 0; j < around.size(); ++j)
    for (int a = 0; a < N; ++a)
      for (int b = 0; b < N; ++b) B(a, b) += around.V[j] * around.dW[j][a] * around.s[j][b];
  out.condition = condition_number(B);
  const Eigen::Matrix<double, N, N> L = B.inverse();
  out.gradient.assign(around.size(), {});
  for (std::size_t j = 0; j < around.size(); ++j) {
    if (j == around.centre) continue;
    for (int a = 0; a < N; ++a)
      for (int b = 0; b < N; ++b) out.gradient[j][a] += L(a, b) * around.V[j] * around.dW[j][b];
    out.gradient[around.centre] -= out.gradient[j];
  }
}

}  // namespace undine::approximation
