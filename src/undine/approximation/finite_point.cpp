#include "undine/approximation/finite_point.hpp"

#include <cmath>

#include "undine/approximation/coefficients.hpp"
#include "undine/approximation/fixed_fit.hpp"

namespace undine::approximation {

template <int N>
void FinitePoint::weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out) {
  const auto count = static_cast<Eigen::Index>(around.size());
  Eigen::MatrixXd P(count, terms(N, order));
  Eigen::VectorXd w(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    P.row(j) = taylor_basis<N>(around.s[j], order).transpose();
    w[j] = std::sqrt(around.W[j]);
  }
  const FixedFit fit(P, w);
  out.condition = fit.condition;
  stencil_of_coefficients<N>(fit.coefficients, 0, out);
}

template void FinitePoint::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void FinitePoint::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void FinitePoint::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
