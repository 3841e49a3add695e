#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct Continuity {
  static constexpr Info info{"continuity",
                             "Density carried by the continuity equation; the partner of pressure form `symmetric`",
                             "drho_a/dt = sum_b m_b (v_a - v_b) . grad_a W_ab",
                             "Monaghan (1992), eq. 2.17; Saalfeld (2012), eq. 36; Niedoba (2012), eq. 2.61"};
  using reads = Fields<m, v>;
  using adds = Fields<drho>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(b.m * dot(a.v - b.v, ab.grad_w));
  }
};

struct ContinuityVolume {
  static constexpr Info info{
      "continuity_volume", "Continuity weighted by the neighbours' volumes; the partner of pressure form `sum`",
      "drho_a/dt = rho_a sum_b (m_b/rho_b) (v_a - v_b) . grad_a W_ab", "Saalfeld (2012), eq. 37"};
  using reads = Fields<m, rho, v>;
  using adds = Fields<drho>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(a.rho * (b.m / b.rho) * dot(a.v - b.v, ab.grad_w));
  }
};

}  // namespace undine::terms
