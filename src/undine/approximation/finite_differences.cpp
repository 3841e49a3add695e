#include "undine/approximation/finite_differences.hpp"

#include "undine/approximation/coefficients.hpp"
#include "undine/approximation/fixed_fit.hpp"

namespace undine::approximation {

template <int N>
void FiniteDifferences::weigh(const Neighbourhood<N>& around, int order, Stencil<N>& out) {
  const auto count = static_cast<Eigen::Index>(around.size()), centre = static_cast<Eigen::Index>(around.centre);
  const int unknowns = terms(N, order) - 1;
  Eigen::MatrixXd P(count, unknowns);
  Eigen::VectorXd W(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    P.row(j) = taylor_basis<N>(around.s[j], order).tail(unknowns).transpose();
    W[j] = j == centre ? 0 : around.W[j];
  }
  FixedFit fit(P, W);
  out.condition = fit.condition;
  fit.coefficients.col(centre) = -fit.coefficients.rowwise().sum();  // the data are u_j - u_i
  stencil_of_coefficients<N>(fit.coefficients, 1, out);
  out.value.assign(around.size(), 0);
  out.value[around.centre] = 1;
}

template void FiniteDifferences::weigh(const Neighbourhood<1>&, int, Stencil<1>&);
template void FiniteDifferences::weigh(const Neighbourhood<2>&, int, Stencil<2>&);
template void FiniteDifferences::weigh(const Neighbourhood<3>&, int, Stencil<3>&);

}  // namespace undine::approximation
