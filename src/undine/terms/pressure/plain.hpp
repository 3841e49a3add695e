#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct PressurePlain {
  static constexpr Info info{"plain", "Unsymmetric gradient of the pressure: breaks momentum and angular momentum",
                             "dv_a/dt = - 1/rho_a sum_b m_b p_b/rho_b grad_a W_ab", "Saalfeld (2012), eq. 38"};
  using reads = Fields<m, rho, p>;
  using adds = Fields<acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(-b.m * b.p / (a.rho * b.rho) * ab.grad_w);
  }
};

struct PressureDifference {
  static constexpr Info info{
      "difference", "Gradient of the pressure difference: exact for constant pressure, breaks momentum",
      "dv_a/dt = - 1/rho_a sum_b m_b (p_b - p_a)/rho_b grad_a W_ab", "Monaghan (1992), eq. 2.9 applied to p"};
  using reads = Fields<m, rho, p>;
  using adds = Fields<acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(-b.m * (b.p - a.p) / (a.rho * b.rho) * ab.grad_w);
  }
};

}  // namespace undine::terms
