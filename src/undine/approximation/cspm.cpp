#include "undine/approximation/cspm.hpp"

#include <algorithm>

#include "undine/approximation/corrected.hpp"
#include "undine/approximation/polynomials.hpp"

namespace undine::approximation {
namespace {

/// The second derivatives as a vector, in the order of the quadratic terms of the Taylor basis.
template <int N>
void corrected_hessian(const Neighbourhood<N>& around, Stencil<N>& out) {
  constexpr int first = 1 + N, pairs = N * (N + 1) / 2;
  using Pairs = Eigen::Matrix<double, pairs, 1>;
  const std::size_t count = around.size();
  std::vector<Pairs> V_ddW(count);
  Eigen::Matrix<double, pairs, pairs> K = Eigen::Matrix<double, pairs, pairs>::Zero();
  Eigen::Matrix<double, pairs, N> first_moment = Eigen::Matrix<double, pairs, N>::Zero();  // sum_j V_j ddW_j (x) s_j
  for (std::size_t j = 0; j < count; ++j) {
    for (int a = 0; a < N; ++a)
      for (int b = a; b < N; ++b) V_ddW[j][quadratic<N>(a, b) - first] = around.V[j] * around.ddW[j][a][b];
    const Terms p = taylor_basis<N>(around.s[j], 2);
    K += V_ddW[j] * p.segment(first, pairs).transpose();
    first_moment += V_ddW[j] * p.segment(1, N).transpose();
  }
  out.condition = std::max(out.condition, condition_number(K));
  const Eigen::FullPivLU<Eigen::Matrix<double, pairs, pairs>> solver(K);
  out.hessian.assign(count, {});
  Pairs at_centre = Pairs::Zero();  // weights of u_j - u_c, summed
  const auto put = [&](std::size_t j, const Pairs& q) {
    for (int a = 0; a < N; ++a)
      for (int b = 0; b < N; ++b) out.hessian[j][a][b] = q[quadratic<N>(a, b) - first];
  };
  for (std::size_t j = 0; j < count; ++j) {
    if (j == around.centre) continue;
    Eigen::Matrix<double, N, 1> g;
    for (int a = 0; a < N; ++a) g[a] = out.gradient[j][a];
    const Pairs q = solver.solve(Pairs(V_ddW[j] - first_moment * g));
    at_centre -= q;
    put(j, q);
  }
  put(around.centre, at_centre);
}

}  // namespace

template <int N>
void Cspm::weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out) {
  corrected_gradient(around, out);
  if (order == 2) corrected_hessian(around, out);
  double S = 0;
  for (std::size_t j = 0; j < around.size(); ++j) S += around.V[j] * around.W[j];
  for (std::size_t j = 0; j < around.size(); ++j) out.value.push_back(around.V[j] * around.W[j] / S);
}

template void Cspm::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void Cspm::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void Cspm::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
