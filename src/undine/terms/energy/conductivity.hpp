#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/value.hpp"

namespace undine::terms {
using namespace field;

/// Opposite in a pair, so that heat is only moved; it vanishes at contacts whose pressure is even.
struct ConductivityPressure {
  static constexpr Info info{
      "price", "Artificial conductivity at contacts, by the jump of pressure; conserves energy",
      "de_a/dt = alpha_u sum_b m_b/rho_ab v_u (e_a - e_b) r_ab.grad_a W_ab/|r_ab|, v_u = sqrt(|p_a - p_b|/rho_ab)",
      "Price (2008), eq. 28 and 34"};
  using reads = Fields<m, rho, p, e>;
  using adds = Fields<de>;

  double alpha_u = 1;
  static constexpr auto parameters() {
    return std::array{Parameter<ConductivityPressure>{"alpha_u", &ConductivityPressure::alpha_u, "1", "strength", 0}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto v_u = sqrt(abs(a.p - b.p) * ab.inv_rho);
    const auto slope = dot(ab.dx, ab.grad_w) * ab.r * ab.inv_r_sq;  // dW/dr
    return adds::row(alpha_u * b.m * ab.inv_rho * v_u * (a.e - b.e) * slope);
  }
};

}  // namespace undine::terms
