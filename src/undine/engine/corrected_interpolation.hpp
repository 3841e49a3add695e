#pragma once
#include <Eigen/Dense>
#include <cmath>

#include "undine/engine/interpolate.hpp"

namespace undine {

/// The fluid at a point by an interpolation that is exact for linear fields. Where the particles near it do not span
/// space, rho and v are means weighted by the kernel (Shepard) and the gradient is zero.
template <int N>
struct CorrectedFluid {
  double weight = 0;  ///< sum V W: 0 where no fluid is near, and then nothing else is known
  double rho = 0;     ///< kg/m^3
  Vec<N> grad_rho{};  ///< kg/m^4
  Vec<N> v{};         ///< m/s
};

/// (f, grad f) = A^-1 b with A = sum_b V_b (W, grad W)^T (1, x_b - x), b = sum_b V_b f_b (W, grad W); V = m/rho. Liu &
/// Liu (2006). Lengths are in units of the uniform H, so that det A is about 1 inside the fluid.
template <int N>
CorrectedFluid<N> interpolate_corrected(const InterpolationSource<N>& source, const Vec<N>& x) {
  constexpr double least_determinant = 1e-3;
  using Matrix = Eigen::Matrix<double, N + 1, N + 1>;
  const auto m = source.store.template get<field::m>();
  const auto rho = source.store.template get<field::rho>();
  const auto v = source.store.template get<field::v>();
  const auto at = source.store.template get<field::x>();
  const auto support = source.store.template get<field::h>();

  Matrix A = Matrix::Zero();
  Eigen::Matrix<double, N + 1, N + 1> b = Matrix::Zero();  // columns: rho, v
  std::vector<std::uint32_t> found;
  source.neighbours.near_point(x, Group::fluid, source.store, found);
  const double unit = source.support.uniform;
  source.kernel.visit([&](auto kernel) {
    for (const std::uint32_t j : found) {
      const double H = source.support.per_particle ? support[j] : unit;
      const Vec<N> ahead = source.domain.nearest_image(at[j] - x) / unit;
      const double R = norm(ahead) * (unit / H);
      if (!(R < 1)) continue;
      double volume = m[j] / rho[j];
      for (int k = 0; k < N; ++k) volume /= H;
      Eigen::Matrix<double, N + 1, 1> test, basis, values;
      test(0) = volume * kernel.template w<N>(R);
      const double slope = -volume * kernel.template slope_over_R<N>(R) * sq(unit / H);
      basis(0) = 1;
      values(0) = rho[j];
      for (int k = 0; k < N; ++k) {
        test(k + 1) = slope * ahead[k];
        basis(k + 1) = ahead[k];
        values(k + 1) = v[j][k];
      }
      A += test * basis.transpose();
      b += test * values.transpose();
    }
  });
  CorrectedFluid<N> fluid;
  fluid.weight = A(0, 0);
  if (!(fluid.weight > 0)) return {};
  Matrix solved = Matrix::Zero();
  if (std::abs(A.determinant()) > least_determinant) {
    solved = A.inverse() * b;
  } else {
    solved.row(0) = b.row(0) / fluid.weight;
  }
  fluid.rho = solved(0, 0);
  for (int k = 0; k < N; ++k) {
    fluid.grad_rho[k] = solved(k + 1, 0) / unit;
    fluid.v[k] = solved(0, k + 1);
  }
  return fluid;
}

}  // namespace undine
