#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/value.hpp"

namespace undine::terms {
using namespace field;

/// B_ab is an artificial pressure that keeps the two particles of a pair apart. Pressure does not do it: its force
/// vanishes with the slope of the kernel at r = 0, in thin jets p is about zero or below, and density diffusion evens
/// out what an approach adds to two densities. Monaghan (2000) takes R (W(r)/W(dx))^n with R a share of |p|/rho^2; as
/// pairs form where |p| is small, the strength is given here, and it ends below the spacing, so that orderly fluid does
/// not feel it. It depends on r alone and is the same at both ends: momentum is conserved, and its work is a potential.
struct PressureSymmetric {
  static constexpr Info info{
      "symmetric", "Pressure force of the variational form; conserves momentum and angular momentum",
      "dv_a/dt = - sum_b m_b (p_a/rho_a^2 + p_b/rho_b^2 + B_ab) grad_a W_ab, "
      "B_ab = separation/rho_ab max(0, 1 - (r/reach)^2)^2",
      "Monaghan (1992), eq. 3.3; Saalfeld (2012), eq. 42 (sign corrected); Niedoba (2012), eq. 2.63; B_ab after "
      "Monaghan (2000)"};
  using reads = Fields<m, rho, p>;
  using adds = Fields<acc>;

  double separation = 0;
  double reach = 1;
  static constexpr auto parameters() {
    using P = Parameter<PressureSymmetric>;
    return std::array{
        P{"separation", &PressureSymmetric::separation, "m^2/s^2", "strength of what keeps pairs apart", 0},
        P{"reach", &PressureSymmetric::reach, "m", "distance below which it acts", 0}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto nearness = negative_part(ab.r_sq * (1 / sq(reach)) - 1.0);
    const auto B_ab = separation * sq(nearness) * ab.inv_rho;
    return adds::row(-b.m * (a.p / sq(a.rho) + b.p / sq(b.rho) + B_ab) * ab.grad_w);
  }
};

}  // namespace undine::terms
