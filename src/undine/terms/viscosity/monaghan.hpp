#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/value.hpp"

namespace undine::terms {
using namespace field;

struct ViscosityMonaghan {
  static constexpr Info info{"monaghan", "Artificial viscosity, active on approach",
                             "dv_a/dt = - sum_b m_b Pi_ab grad_a W_ab, Pi_ab = (-alpha c mu_ab + beta mu_ab^2)/rho, "
                             "mu_ab = h min(0, v_ab.r_ab)/(r^2 + 0.01 h^2), c and rho means of the pair",
                             "Monaghan (1992), eq. 4.1-4.2; Saalfeld (2012), eq. 45-46; Niedoba (2012), eq. 2.70"};
  using reads = Fields<m, rho, c, v>;
  using adds = Fields<acc>;

  double alpha = 0.02;
  double beta = 0;
  static constexpr auto parameters() {
    using P = Parameter<ViscosityMonaghan>;
    return std::array{P{"alpha", &ViscosityMonaghan::alpha, "1", "strength of the linear (bulk and shear) part", 0},
                      P{"beta", &ViscosityMonaghan::beta, "1", "strength of the quadratic (shock) part", 0}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto mu_ab = ab.h * negative_part(dot(a.v - b.v, ab.dx)) * ab.inv_r_sq;
    const auto pi_ab = (-alpha * 0.5 * (a.c + b.c) * mu_ab + beta * sq(mu_ab)) * ab.inv_rho;
    return adds::row(-b.m * pi_ab * ab.grad_w);
  }
};

}  // namespace undine::terms
