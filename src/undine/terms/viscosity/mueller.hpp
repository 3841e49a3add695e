#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct ViscosityMueller {
  static constexpr Info info{"mueller", "Laminar viscosity by the Laplacian of the kernel (mean mu of the pair)",
                             "dv_a/dt = sum_b m_b mu (v_b - v_a)/(rho_a rho_b) lap W_ab",
                             "Mueller et al. (2003); Saalfeld (2012), eq. 48"};
  using reads = Fields<m, rho, mu, v>;
  using adds = Fields<acc>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(b.m * 0.5 * (a.mu + b.mu) / (a.rho * b.rho) * ab.laplacian_w() * (b.v - a.v));
  }
};

}  // namespace undine::terms
