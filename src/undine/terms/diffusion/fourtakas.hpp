#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"

namespace undine::terms {
using namespace field;

struct DiffusionFourtakas {
  static constexpr Info info{
      "fourtakas", "Density diffusion of what deviates from the hydrostatic difference",
      "as `molteni`, with (rho_b - rho_a) - (rho_a + rho_b)/2 g.(x_b - x_a)/c^2 for the density difference",
      "Fourtakas et al. (2019), eq. 11 (hydrostatic part linear in p/(rho c^2))"};
  using reads = Fields<m, rho, c>;
  using adds = Fields<drho_diff>;

  double delta = 0.1;
  Vec<3> gravity;  ///< the case's gravity, m/s^2; set by the scheme
  static constexpr auto parameters() {
    return std::array{
        Parameter<DiffusionFourtakas>{"delta", &DiffusionFourtakas::delta, "1", "strength of the diffusion", 0}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    auto g_dx = gravity[0] * ab.dx[0];
    for (int k = 1; k < ab.dim; ++k) g_dx = g_dx + gravity[k] * ab.dx[k];
    const auto hydrostatic = -0.5 * (a.rho + b.rho) * g_dx / (a.c * b.c);
    const auto f = -dot(ab.dx, ab.grad_w) * ab.inv_r_sq;
    return adds::row(delta * ab.h * (a.c + b.c) * (b.m / b.rho) * (b.rho - a.rho - hydrostatic) * f);
  }
};

}  // namespace undine::terms
