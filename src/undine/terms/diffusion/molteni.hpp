#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"

namespace undine::terms {
using namespace field;

struct DiffusionMolteni {
  static constexpr Info info{
      "molteni", "Density diffusion of the whole density difference; disturbs hydrostatic pressure at a surface",
      "drho_a/dt = 2 delta h c sum_b (m_b/rho_b) (rho_b - rho_a) (-r_ab.grad_a W_ab)/(r^2 + 0.01 h^2)",
      "Molteni & Colagrossi (2009), eq. 7"};
  using reads = Fields<m, rho, c>;
  using adds = Fields<drho_diff>;

  double delta = 0.1;
  static constexpr auto parameters() {
    return std::array{
        Parameter<DiffusionMolteni>{"delta", &DiffusionMolteni::delta, "1", "strength of the diffusion", 0}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto f = -dot(ab.dx, ab.grad_w) * ab.inv_r_sq;
    return adds::row(delta * ab.h * (a.c + b.c) * (b.m / b.rho) * (b.rho - a.rho) * f);
  }
};

}  // namespace undine::terms
