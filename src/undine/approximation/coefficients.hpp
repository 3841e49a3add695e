#pragma once
#include <Eigen/Core>

#include "undine/approximation/polynomials.hpp"
#include "undine/approximation/stencil.hpp"

namespace undine::approximation {

/// Makes a stencil of the weights of Taylor coefficients: row k of `c` is term `first` + k of the basis, column j is
/// point j. `first` is 0, or 1 where the value does not come from the rows.
template <int N>
void stencil_of_coefficients(const Eigen::MatrixXd& c, int first, Stencil<N>& out) {
  const auto count = static_cast<std::size_t>(c.cols());
  const auto row = [&](int term, std::size_t j) { return c(term - first, static_cast<Eigen::Index>(j)); };
  const auto rows = static_cast<int>(c.rows()) + first;
  if (first == 0) out.value.resize(count);
  if (rows > 1) out.gradient.resize(count);
  if (rows > 1 + N) out.hessian.resize(count);
  for (std::size_t j = 0; j < count; ++j) {
    if (first == 0) out.value[j] = row(0, j);
    for (int a = 0; a < N && rows > 1; ++a) out.gradient[j][a] = row(1 + a, j);
    for (int a = 0; a < N && rows > 1 + N; ++a)
      for (int b = 0; b < N; ++b) out.hessian[j][a][b] = row(quadratic<N>(a, b), j);
  }
}

}  // namespace undine::approximation
