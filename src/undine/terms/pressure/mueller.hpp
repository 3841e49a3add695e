#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct PressureMueller {
  static constexpr Info info{"mueller",
                             "Pressure force by the mean pressure, as printed by Saalfeld; half as strong as `sum`",
                             "dv_a/dt = - sum_b m_b (p_a + p_b)/(2 rho_a rho_b) grad_a W_ab",
                             "Mueller et al. (2003); Saalfeld (2012), eq. 43"};
  using reads = Fields<m, rho, p>;
  using adds = Fields<acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(-0.5 * b.m * (a.p + b.p) / (a.rho * b.rho) * ab.grad_w);
  }
};

}  // namespace undine::terms
