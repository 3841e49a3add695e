#pragma once
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <limits>

#include "undine/approximation/fixed_fit.hpp"
#include "undine/approximation/neighbourhood.hpp"
#include "undine/approximation/polynomials.hpp"

namespace undine::approximation {

/// A symmetric system solved by its eigenvectors, which also give its condition number.
class SymmetricSystem {
 public:
  explicit SymmetricSystem(const Moments& A) : A_(A), eigen_(A) {
    const Terms size = eigen_.eigenvalues().cwiseAbs();
    condition_ = size.minCoeff() > 0 ? size.maxCoeff() / size.minCoeff() : std::numeric_limits<double>::infinity();
  }
  double condition() const { return condition_; }
  Terms solve(const Terms& r) const {
    const Terms x = once(r);
    return x + once(r - A_ * x);  // refined: what is left of the residual is rounding of the sums
  }

 private:
  Terms once(const Terms& r) const {
    return eigen_.eigenvectors() * (eigen_.eigenvectors().transpose() * r).cwiseQuotient(eigen_.eigenvalues());
  }
  Moments A_;
  Eigen::SelfAdjointEigenSolver<Moments> eigen_;
  double condition_;
};

/// The fit of a polynomial whose weights w_j(x) move with x, and its true derivatives, those of the weights included.
/// Belytschko, Lu & Gu (1994); with p_j the basis at x_j and p the basis at x:
///   A = sum_j w_j p_j p_j^T,  A b = p
///   A d_a b = d_a p - d_a A b,  A d_ab b = d_ab p - d_ab A b - d_a A d_b b - d_b A d_a b
///   phi_j = w_j p_j.b,  d_a phi_j = p_j.(d_a w_j b + w_j d_a b), and so on
/// The weight of point j is W_j times factor(j).
template <int N>
void moving_fit(const Neighbourhood<N>& around, int degree, auto&& factor, Stencil<N>& out) {
  const int m = terms(N, degree);
  const bool twice = !around.ddW.empty();
  const std::size_t count = around.size();
  Moments A = Moments::Zero(m, m);
  std::array<Moments, N> dA;
  std::array<std::array<Moments, N>, N> ddA;
  for (int a = 0; a < N; ++a) {
    dA[a] = A;
    for (int b = a; b < N; ++b) ddA[a][b] = A;
  }
  // The basis p = R^-T times the Taylor basis, orthonormal for the weights' sizes: then A is the unit matrix where all
  // weights are positive, and rounding grows by the root of the condition number only.
  Eigen::MatrixXd rooted(count, m);
  std::vector<Terms> p(count);
  for (std::size_t j = 0; j < count; ++j) {
    p[j] = taylor_basis<N>(around.s[j], degree);
    rooted.row(static_cast<Eigen::Index>(j)) = std::sqrt(std::abs(factor(j) * around.W[j])) * p[j].transpose();
  }
  const Moments R = Eigen::HouseholderQR<Eigen::MatrixXd>(rooted).matrixQR().topRows(m);
  const auto upper = R.triangularView<Eigen::Upper>();
  out.condition = sq(condition_number(Moments(upper)));
  if (!std::isfinite(out.condition)) return;
  const auto orthonormal = [&](const Terms& taylor) -> Terms { return upper.transpose().solve(taylor); };
  const auto at_x = [&](int term) { return orthonormal(unit_term(m, term)); };  // p = e_0, d_a p = e_a, d_ab p = e_ab

  for (std::size_t j = 0; j < count; ++j) {
    p[j] = orthonormal(p[j]);
    const Moments pp = factor(j) * p[j] * p[j].transpose();
    A += around.W[j] * pp;
    for (int a = 0; a < N; ++a) {
      dA[a] += around.dW[j][a] * pp;
      for (int b = a; twice && b < N; ++b) ddA[a][b] += around.ddW[j][a][b] * pp;
    }
  }
  const SymmetricSystem system(A);
  out.condition *= system.condition();
  const Terms b0 = system.solve(at_x(0));
  std::array<Terms, N> db;
  std::array<std::array<Terms, N>, N> ddb;
  for (int a = 0; a < N; ++a) db[a] = system.solve(at_x(1 + a) - dA[a] * b0);
  for (int a = 0; twice && a < N; ++a)
    for (int b = a; b < N; ++b)
      ddb[a][b] = system.solve(at_x(quadratic<N>(a, b)) - ddA[a][b] * b0 - dA[a] * db[b] - dA[b] * db[a]);

  out.value.resize(count);
  out.gradient.resize(count);
  out.hessian.resize(twice ? count : 0);
  for (std::size_t j = 0; j < count; ++j) {
    const double f = factor(j), W = around.W[j];
    const Vec<N>& dW = around.dW[j];
    const double pb = p[j].dot(b0);
    Vec<N> pdb;
    for (int a = 0; a < N; ++a) pdb[a] = p[j].dot(db[a]);
    out.value[j] = f * W * pb;
    out.gradient[j] = f * (pb * dW + W * pdb);
    for (int a = 0; twice && a < N; ++a)
      for (int b = a; b < N; ++b)
        out.hessian[j][a][b] = out.hessian[j][b][a] =
            f * (around.ddW[j][a][b] * pb + dW[a] * pdb[b] + dW[b] * pdb[a] + W * p[j].dot(ddb[a][b]));
  }
}

}  // namespace undine::approximation
