#include "undine/approximation/radial_point_interpolation.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "undine/approximation/coefficients.hpp"

namespace undine::approximation {
namespace {

/// B = t^q, t = s^2 + c^2, with grad B = 2 q t^(q-1) s and grad grad B = 2 q t^(q-1) I + 4 q (q-1) t^(q-2) s (x) s.
struct Multiquadric {
  static constexpr double q = RadialPointInterpolation::q;
  double c_sq;

  template <int N>
  double value(const Vec<N>& s) const {
    return std::pow(norm_sq(s) + c_sq, q);
  }
  template <int N>
  double gradient(const Vec<N>& s, int a) const {
    return 2 * q * std::pow(norm_sq(s) + c_sq, q - 1) * s[a];
  }
  template <int N>
  double hessian(const Vec<N>& s, int a, int b) const {
    const double t = norm_sq(s) + c_sq;
    return 2 * q * std::pow(t, q - 1) * (a == b) + 4 * q * (q - 1) * std::pow(t, q - 2) * s[a] * s[b];
  }
};

}  // namespace

template <int N>
void RadialPointInterpolation::weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out) {
  using std::numbers::pi;
  constexpr double unit_ball = N == 1 ? 2 : N == 2 ? pi : 4 * pi / 3;
  constexpr int all = terms(N, 2);  // value, gradient, Hessian
  const auto n = static_cast<Eigen::Index>(around.size()), m = Eigen::Index{terms(N, order)};
  const double d_c = std::pow(unit_ball / static_cast<double>(n), 1.0 / N);
  const Multiquadric B{sq(alpha_c * d_c)};

  // G (a, c) = (u, 0). G is symmetric, so that the weights of u in a functional F of (a, c) solve G (phi, .) = F.
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(n + m, n + m), F = Eigen::MatrixXd::Zero(n + m, all);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Vec<N>& s = around.s[j];
    for (Eigen::Index k = 0; k < n; ++k) G(j, k) = B.value(s - around.s[k]);
    const Terms p = taylor_basis<N>(s, order);
    G.block(j, n, 1, m) = p.transpose();
    G.block(n, j, m, 1) = p;
    F(j, 0) = B.value(s);
    for (int a = 0; a < N; ++a) {
      F(j, 1 + a) = B.gradient(-s, a);
      for (int b = a; b < N; ++b) F(j, quadratic<N>(a, b)) = B.hessian(-s, a, b);
    }
  }
  F.block(n, 0, m, m) = Eigen::MatrixXd::Identity(m, m);
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(G);
  out.condition = 1 / solver.rcond();  // in the 1-norm, estimated
  stencil_of_coefficients<N>(solver.solve(F).topRows(n).transpose(), 0, out);
}

template void RadialPointInterpolation::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void RadialPointInterpolation::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void RadialPointInterpolation::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
