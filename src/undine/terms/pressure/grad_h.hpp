#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

// Pressure forces that follow from a Lagrangian in which H follows density: grad W_ab(H_a) and grad W_ab(H_b) each with
// its own factor. A pair acts within the larger of both supports. Work of the same names is in terms/energy/grad_h.hpp.

/// With density form `grad_h`, rho = m times number density; for equal masses this is `grad_h_mass`.
struct PressureGradH {
  static constexpr Info info{
      "grad_h", "Variational pressure force of the number density; conserves momentum, and energy with its partner",
      "dv_a/dt = - 1/m_a sum_b (m_a^2 p_a/(Omega_a rho_a^2) grad_a W_ab(H_a) + m_b^2 p_b/(Omega_b rho_b^2) grad_a "
      "W_ab(H_b))",
      "Hopkins (2013), general equation of motion, with volumes m/rho; Springel & Hernquist (2002)"};
  using reads = Fields<m, rho, p, omega>;
  using adds = Fields<acc>;
  static constexpr bool needs_both_supports = true;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(-a.m * a.p / (a.omega * sq(a.rho)) * ab.grad_w_a -
                     sq(b.m) * b.p / (a.m * b.omega * sq(b.rho)) * ab.grad_w_b);
  }
};

struct PressureGradHMass {
  static constexpr Info info{
      "grad_h_mass",
      "Variational pressure force of the summed density; conserves momentum, and energy with its partner",
      "dv_a/dt = - sum_b m_b (p_a/(Omega_a rho_a^2) grad_a W_ab(H_a) + p_b/(Omega_b rho_b^2) grad_a W_ab(H_b))",
      "Springel & Hernquist (2002); Price (2012), equations of motion with variable h"};
  using reads = Fields<m, rho, p, omega>;
  using adds = Fields<acc>;
  static constexpr bool needs_both_supports = true;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(-b.m * (a.p / (a.omega * sq(a.rho)) * ab.grad_w_a + b.p / (b.omega * sq(b.rho)) * ab.grad_w_b));
  }
};

}  // namespace undine::terms
