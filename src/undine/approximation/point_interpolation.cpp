#include "undine/approximation/point_interpolation.hpp"

#include <Eigen/QR>

#include "undine/approximation/coefficients.hpp"
#include "undine/approximation/fixed_fit.hpp"

namespace undine::approximation {

template <int N>
void PointInterpolation::weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out) {
  const auto count = static_cast<Eigen::Index>(around.size());
  const int m = terms(N, order);
  Eigen::MatrixXd preferred(m, count);
  for (Eigen::Index j = 0; j < count; ++j)
    preferred.col(j) = cube(1 - norm_sq(around.s[j])) * taylor_basis<N>(around.s[j], order);
  const auto chosen = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(preferred).colsPermutation().indices().head(m).eval();

  Eigen::MatrixXd P(m, m);
  for (int k = 0; k < m; ++k) P.row(k) = taylor_basis<N>(around.s[chosen[k]], order).transpose();
  const FixedFit inverse(P, Eigen::VectorXd::Ones(m));
  out.condition = inverse.condition;
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(m, count);
  for (int k = 0; k < m; ++k) c.col(chosen[k]) = inverse.coefficients.col(k);
  stencil_of_coefficients<N>(c, 0, out);
}

template void PointInterpolation::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void PointInterpolation::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void PointInterpolation::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
