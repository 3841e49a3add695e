#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct VelocityGradient {
  static constexpr Info info{"velocity_gradient", "Gradient of the velocity, for the dissipation of viscous flow",
                             "L_a = sum_b (m_b/rho_b) grad_a W_ab (x) (v_b - v_a)", "Saalfeld (2012), eq. 52-54"};
  using reads = Fields<m, rho, v>;
  using adds = Fields<strain>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(outer(ab.grad_w, (b.m / b.rho) * (b.v - a.v)));
  }
};

}  // namespace undine::terms
