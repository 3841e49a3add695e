#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

// Work of the pressure forces of the same names: p_a/rho_a^2 times the rate of the density of the same name, so that
// entropy stays what it is.

struct EnergyGradH {
  static constexpr Info info{"grad_h", "Work of pressure form `grad_h`: conserves energy and entropy",
                             "de_a/dt = m_a p_a/(Omega_a rho_a^2) sum_b (v_a - v_b).grad_a W_ab(H_a)",
                             "Hopkins (2013), general equation of energy; Springel & Hernquist (2002)"};
  using reads = Fields<m, rho, p, omega, v>;
  using adds = Fields<de>;
  static constexpr bool needs_both_supports = true;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(a.m * a.p / (a.omega * sq(a.rho)) * dot(a.v - b.v, ab.grad_w_a));
  }
};

struct EnergyGradHMass {
  static constexpr Info info{"grad_h_mass", "Work of pressure form `grad_h_mass`: conserves energy and entropy",
                             "de_a/dt = p_a/(Omega_a rho_a^2) sum_b m_b (v_a - v_b).grad_a W_ab(H_a)",
                             "Price (2012), internal energy with variable h; Springel & Hernquist (2002)"};
  using reads = Fields<m, rho, p, omega, v>;
  using adds = Fields<de>;
  static constexpr bool needs_both_supports = true;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(b.m * a.p / (a.omega * sq(a.rho)) * dot(a.v - b.v, ab.grad_w_a));
  }
};

}  // namespace undine::terms
