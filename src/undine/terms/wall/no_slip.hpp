#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/terms/viscosity/laminar.hpp"
#include "undine/terms/viscosity/mueller.hpp"

namespace undine::terms {
using namespace field;

/// A viscous force between fluid and a wall to which it sticks: the wall answers with the velocity that, averaged with
/// the fluid's, is the wall's own.
template <class Form>
struct NoSlip {
  static constexpr Info info{Form::info.name, Form::info.title, Form::info.equation, Form::info.citation};
  using reads = Fields<m, rho, mu, v_friction>;
  using adds = Fields<acc_wall>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(Form{}(with_friction_velocity(a), with_friction_velocity(b), ab).acc);
  }

  static constexpr auto with_friction_velocity(const auto& particle) {
    return Fields<m, rho, mu, v>::row(particle.m, particle.rho, particle.mu, particle.v_friction);
  }
};

/// The velocity of the fluid past a wall particle: v_w = 2 v_wall - <v> is v_wall less its mean.
struct WallSlip {
  static constexpr Info info{"wall_slip", "Velocity of the fluid past a wall particle",
                             "s_w = sum_f V_f (v_f - v_w) W_wf, to be divided by sum_f V_f W_wf",
                             "Adami et al. (2012), eq. 22-23"};
  using reads = Fields<m, rho, v>;
  using target_reads = Fields<v>;
  using adds = Fields<slip_sum>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(b.m / b.rho * ab.w * (b.v - a.v));
  }
};

}  // namespace undine::terms
