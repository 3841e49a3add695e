#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"

namespace undine::terms {
using namespace field;

/// Particles move down the gradient of their own concentration, which keeps them evenly spread: a diffusion of places,
/// not of what they carry. The transport velocity of Adami, Hu & Adams (2013), dt p_b/rho 2 sum_b V_b grad_a W_ab, is
/// C = 1/6 with their p_b = rho c^2, dt = h/(4 c) and H = 3 h; this one does not depend on the step.
struct ShiftingFickian {
  static constexpr Info info{"fickian", "Particles drift from where they are dense to where they are sparse",
                             "dx_a/dt = v_a + s_a, s_a = - C c_a H sum_b (m_b/rho_b) grad_a W_ab",
                             "Lind et al. (2012); Adami, Hu & Adams (2013)"};
  using reads = Fields<m, rho, c>;
  using adds = Fields<v_xsph>;

  double C = 0.5;
  static constexpr auto parameters() {
    return std::array{Parameter<ShiftingFickian>{"strength", &ShiftingFickian::C, "1", "C", 0, 1}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(-C * a.c * ab.support * (b.m / b.rho) * ab.grad_w);
  }
};

using Shiftings = Catalogue<ShiftingFickian>;

/// What a particle meets that moves with v + s instead of v: it takes the velocity and the density of the places that
/// it comes to. Walls have the velocity of their friction, which goes on where the fluid's ends.
struct ShiftedTransport {
  static constexpr Info info{
      "shifted_transport", "Velocity and density change as a shifted particle comes to others",
      "dv_a/dt = s_a.grad v, drho_a/dt = s_a.grad rho; grad f = sum_b V_b (f_b - f_a) grad_a W_ab",
      "Adami, Hu & Adams (2013); Sun et al. (2019); by differences here"};
  using reads = Fields<m, rho, v_friction, v_xsph>;
  using adds = Fields<acc, drho_diff>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto s_grad = b.m / b.rho * dot(a.v_xsph, ab.grad_w);
    return adds::row(s_grad * (b.v_friction - a.v_friction), s_grad * (b.rho - a.rho));
  }

  FieldSet chosen_reads() const { return reads::set(); }
};

}  // namespace undine::terms
