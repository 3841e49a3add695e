#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/value.hpp"

namespace undine::terms {
using namespace field;

// Artificial conductivity of gases: heat moves from the hotter to the colder, opposite in a pair, so that it is only
// moved. The forms differ in the speed v_u at which it does:
//   de_a/dt = alpha_u sum_b m_b/rho_ab v_u (e_a - e_b) dW/dr

namespace detail {
constexpr auto heat_of_pair(const auto& v_u, double alpha_u, const auto& a, const auto& b, const auto& ab) {
  const auto slope = dot(ab.dx, ab.grad_w) * ab.r * ab.inv_r_sq;  // dW/dr
  return alpha_u * b.m * ab.inv_rho * v_u * (a.e - b.e) * slope;
}
template <class Term>
constexpr auto strength_of_heat() {
  return std::array{Parameter<Term>{"alpha_u", &Term::alpha_u, "1", "strength", 0}};
}
}  // namespace detail

/// Acts while gases approach or part, as where a diaphragm broke or a shock heats a wall, and leaves alone what rests.
struct ConductivityVelocity {
  static constexpr Info info{
      "velocity", "Artificial conductivity by the speed at which a pair closes or parts; conserves energy",
      "de_a/dt = alpha_u sum_b m_b/rho_ab v_u (e_a - e_b) r_ab.grad_a W_ab/|r_ab|, v_u = |v_ab.r_ab|/|r_ab|",
      "Wadsley, Veeravalli & Couchman (2008); Price et al. (2018), for gas under its own gravity"};
  using reads = Fields<m, rho, v, e>;
  using adds = Fields<de>;

  double alpha_u = 1;
  static constexpr auto parameters() { return detail::strength_of_heat<ConductivityVelocity>(); }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto v_u = abs(dot(a.v - b.v, ab.dx)) * ab.r * ab.inv_r_sq;
    return adds::row(detail::heat_of_pair(v_u, alpha_u, a, b, ab));
  }
};

/// Vanishes at contacts whose pressure is even, and acts wherever it is not.
struct ConductivityPressure {
  static constexpr Info info{
      "price", "Artificial conductivity at contacts, by the jump of pressure; conserves energy",
      "de_a/dt = alpha_u sum_b m_b/rho_ab v_u (e_a - e_b) r_ab.grad_a W_ab/|r_ab|, v_u = sqrt(|p_a - p_b|/rho_ab)",
      "Price (2008); Price et al. (2018), for gas without gravity"};
  using reads = Fields<m, rho, p, e>;
  using adds = Fields<de>;

  double alpha_u = 1;
  static constexpr auto parameters() { return detail::strength_of_heat<ConductivityPressure>(); }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto v_u = sqrt(abs(a.p - b.p) * ab.inv_rho);
    return adds::row(detail::heat_of_pair(v_u, alpha_u, a, b, ab));
  }
};

}  // namespace undine::terms
