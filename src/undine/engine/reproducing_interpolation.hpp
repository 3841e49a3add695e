#pragma once
#include <Eigen/Dense>

#include "undine/engine/interpolate.hpp"

namespace undine {

/// The density at particle a by the reproducing kernel particle method over the fluid, itself included. Niedoba (2012),
/// eq. 2.80-2.86, in N dimensions, of order 0 (Shepard's mean) or 1:
///   rho_a = sum_b m_b C_ab W_ab,  C_ab = c_0 + c.d,  d = x_b - x_a,  V = m/rho
///   S c = -m_1/m_0,  c_0 = (1 - c.m_1)/m_0,  m_k = sum_b V_b d^k W_ab,  S = m_2 - m_1 (x) m_1/m_0
/// As sum_b V_b C_ab W_ab = 1, it is taken as rho_a + sum_b V_b (rho_b - rho_a) C_ab W_ab, which keeps its digits.
/// Where the particles near a do not span space, c = 0. Lengths are in units of the uniform H.
template <int N>
double reproduced_density(const InterpolationSource<N>& source, std::size_t a, int order) {
  constexpr double least_determinant = 0.01;  // of S, relative to a neighbourhood that is as wide in all directions
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;
  const auto x = source.store.template get<field::x>();
  const auto m = source.store.template get<field::m>();
  const auto rho = source.store.template get<field::rho>();

  double m_0 = 0, b_0 = 0;
  Vector m_1 = Vector::Zero(), b_1 = Vector::Zero();
  Matrix m_2 = Matrix::Zero();
  for_each_near(source, Group::fluid, x[a], [&](std::size_t b, double W) {
    const Vec<N> ahead = source.domain.nearest_image(x[b] - x[a]) / source.support.uniform;
    Vector d;
    for (int k = 0; k < N; ++k) d(k) = ahead[k];
    const double weight = m[b] / rho[b] * W, excess = weight * (rho[b] - rho[a]);
    m_0 += weight;
    m_1 += weight * d;
    m_2 += weight * d * d.transpose();
    b_0 += excess;
    b_1 += excess * d;
  });
  Vector c = Vector::Zero();
  if (const double square = m_2.trace() / N; order > 0 && square > 0) {
    const Matrix S = (m_2 - m_1 * m_1.transpose() / m_0) / square;
    if (S.determinant() > least_determinant) c = -S.inverse() * m_1 / (m_0 * square);
  }
  return rho[a] + (1 - c.dot(m_1)) / m_0 * b_0 + c.dot(b_1);
}

}  // namespace undine
