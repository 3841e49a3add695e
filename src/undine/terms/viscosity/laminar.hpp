#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct ViscosityLaminar {
  static constexpr Info info{"laminar", "Laminar viscosity as in Saalfeld's set-up (mean mu of the pair)",
                             "dv_a/dt = 1/rho_a sum_b m_b 4 mu r_ab.grad_a W_ab/((rho_a + rho_b)(r^2 + 0.01 h^2)) v_ab",
                             "Morris et al. (1997); Saalfeld (2012), eq. 49 (with the usual 0.01 h^2 against r = 0)"};
  using reads = Fields<m, rho, mu, v>;
  using adds = Fields<acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto f = (a.mu + b.mu) * dot(ab.dx, ab.grad_w) * ab.inv_r_sq * ab.inv_rho;
    return adds::row(b.m / a.rho * f * (a.v - b.v));
  }
};

struct ViscosityMorris {
  static constexpr Info info{"morris", "Laminar viscosity, symmetric in the pair: conserves momentum",
                             "dv_a/dt = sum_b m_b (mu_a + mu_b) r_ab.grad_a W_ab/(rho_a rho_b (r^2 + 0.01 h^2)) v_ab",
                             "Morris et al. (1997), eq. 22"};
  using reads = Fields<m, rho, mu, v>;
  using adds = Fields<acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto f = (a.mu + b.mu) * dot(ab.dx, ab.grad_w) * ab.inv_r_sq / (a.rho * b.rho);
    return adds::row(b.m * f * (a.v - b.v));
  }
};

}  // namespace undine::terms
