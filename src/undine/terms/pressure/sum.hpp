#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct PressureSum {
  static constexpr Info info{"sum", "Pressure force by the sum of pressures; conserves momentum, kind to density jumps",
                             "dv_a/dt = - sum_b m_b (p_a + p_b)/(rho_a rho_b) grad_a W_ab", "Niedoba (2012), eq. 2.62"};
  using reads = Fields<m, rho, p>;
  using adds = Fields<acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(-b.m * (a.p + b.p) / (a.rho * b.rho) * ab.grad_w);
  }
};

}  // namespace undine::terms
