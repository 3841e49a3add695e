#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct PressureSymmetric {
  static constexpr Info info{
      "symmetric", "Pressure force of the variational form; conserves momentum and angular momentum",
      "dv_a/dt = - sum_b m_b (p_a/rho_a^2 + p_b/rho_b^2) grad_a W_ab",
      "Monaghan (1992), eq. 3.3; Saalfeld (2012), eq. 42 (sign corrected); Niedoba (2012), eq. 2.63"};
  using reads = Fields<m, rho, p>;
  using adds = Fields<acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(-b.m * (a.p / sq(a.rho) + b.p / sq(b.rho)) * ab.grad_w);
  }
};

}  // namespace undine::terms
