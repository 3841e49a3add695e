#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "undine/core/fields.hpp"
#include "undine/materials/catalogue.hpp"

namespace undine::rules {
using namespace field;

// Particle updates: what they read and write, and one pure function of a particle's row and its material.

/// p = p(rho), c = c(rho) of the particle's material.
struct ApplyEquationOfState {
  using reads = Fields<rho>;
  using writes = Fields<p, c>;
  const std::vector<materials::Material>& materials;

  auto operator()(const auto& a, int material) const {
    const auto& substance = materials[material];
    return writes::row(substance.pressure(a.rho), substance.sound_speed(a.rho));
  }
};

/// rho = sum_b m_b W_ab.
struct TakeSummedDensity {
  using reads = Fields<rho_sum>;
  using writes = Fields<rho>;
  auto operator()(const auto& a, int) const { return writes::row(a.rho_sum); }
};

/// rho = sum_b m_b W_ab / sum_b (m_b/rho_b) W_ab. Niedoba (2012), eq. 2.58.
struct TakeNormalisedDensity {
  using reads = Fields<rho_sum, w_sum>;
  using writes = Fields<rho>;
  auto operator()(const auto& a, int) const { return writes::row(a.rho_sum / a.w_sum); }
};

/// rho_w = max(rho_0, rho_wref + sum over the fluid). Saalfeld (2012), eq. 70; the lower bound keeps a wall from
/// pulling where its reference is below rho_0.
struct AnswerModifiedDensity {
  using reads = Fields<rho_sum, rho_0, rho_wall>;
  using writes = Fields<rho>;
  auto operator()(const auto& a, int) const { return writes::row(std::max(a.rho_0, a.rho_wall + a.rho_sum)); }
};

/// p_w as the fluid before it has it, zero where there is none; a wall pulls only if it may. rho_w and c_w follow from
/// p_w.
struct AnswerExtrapolatedPressure {
  using reads = Fields<p_sum, w_sum>;
  using writes = Fields<p, rho, c>;
  const std::vector<materials::Material>& materials;
  bool pulls;

  auto operator()(const auto& a, int material) const {
    const auto& substance = materials[material];
    const double rest = substance.pressure(substance.rho_0);
    const double extrapolated = a.w_sum > 1e-6 ? a.p_sum / a.w_sum : rest;
    const double pressure = pulls ? extrapolated : std::max(rest, extrapolated);
    const double density = substance.density(pressure);
    return writes::row(pressure, density, substance.sound_speed(density));
  }
};

/// v_w = 2 v_wall - <v> of the fluid around. Adami et al. (2012), eq. 23.
struct AnswerFrictionVelocity {
  using reads = Fields<v, slip_sum, w_sum>;
  using writes = Fields<v_friction>;
  auto operator()(const auto& a, int) const { return writes::row(a.w_sum > 1e-6 ? a.v - a.slip_sum / a.w_sum : a.v); }
};

/// Fluid meets friction at walls with its own velocity.
struct TakeOwnVelocity {
  using reads = Fields<v>;
  using writes = Fields<v_friction>;
  auto operator()(const auto& a, int) const { return writes::row(a.v); }
};

/// h = h_0 (rho_0/rho)^(1/N). Niedoba (2012), eq. 2.67.
template <int N>
struct FollowDensity {
  using reads = Fields<rho, rho_0>;
  using writes = Fields<h>;
  double support_0;
  auto operator()(const auto& a, int) const { return writes::row(support_0 * std::pow(a.rho_0 / a.rho, 1.0 / N)); }
};

/// G = M^-1 grad rho, exact for linear fields; where the neighbours do not span space (a lone or a flat neighbourhood),
/// the plain gradient is kept. Antuono et al. (2010), eq. 11.
template <int N>
struct RenormaliseGradient {
  using reads = Fields<grad_rho, moment>;
  using writes = Fields<grad_rho_l>;
  auto operator()(const auto& a, int) const {
    Eigen::Matrix<double, N, N> matrix;
    Eigen::Matrix<double, N, 1> gradient;
    for (int i = 0; i < N; ++i) {
      gradient(i) = a.grad_rho[i];
      for (int j = 0; j < N; ++j) matrix(i, j) = a.moment[i][j];
    }
    Vec<N> result = a.grad_rho;
    if (std::abs(matrix.determinant()) > 0.05) {
      const Eigen::Matrix<double, N, 1> solved = matrix.inverse() * gradient;
      for (int i = 0; i < N; ++i) result[i] = solved(i);
    }
    return writes::row(result);
  }
};

/// M -> M^-1, by which kernel gradients become exact for linear fields, and with it G = M^-1 grad rho. Where the
/// neighbours do not span space, and in runs that shift particles but correct nothing, gradients stay as they are.
/// Randles & Libersky (1996); Bonet & Lok (1999).
template <int N>
struct CorrectGradients {
  using reads = Fields<grad_rho, moment>;
  using writes = Fields<moment, grad_rho_l>;
  bool corrects;

  auto operator()(const auto& a, int) const {
    Eigen::Matrix<double, N, N> matrix;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) matrix(i, j) = a.moment[i][j];
    const bool invertible = std::abs(matrix.determinant()) > 0.05;
    const Eigen::Matrix<double, N, N> inverse = invertible ? matrix.inverse().eval() : matrix.Identity();
    Vec<N, Vec<N>> correction{};
    Vec<N> gradient{};
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) {
        correction[i][j] = corrects ? inverse(i, j) : (i == j ? 1 : 0);
        gradient[i] += inverse(i, j) * a.grad_rho[j];
      }
    return writes::row(correction, gradient);
  }
};

}  // namespace undine::rules
