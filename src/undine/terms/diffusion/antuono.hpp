#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"

namespace undine::terms {
using namespace field;

struct DiffusionAntuono {
  static constexpr Info info{
      "antuono", "delta-SPH: density diffusion less its linear part, by renormalised gradients",
      "as `molteni`, with (rho_b - rho_a) - (G_a + G_b)/2 . (x_b - x_a), G the renormalised density gradient",
      "Antuono et al. (2010), eq. 10-12; Antuono et al. (2012)"};
  using reads = Fields<m, rho, c, grad_rho_l>;
  using adds = Fields<drho_diff>;

  double delta = 0.1;
  static constexpr auto parameters() {
    return std::array{
        Parameter<DiffusionAntuono>{"delta", &DiffusionAntuono::delta, "1", "strength of the diffusion", 0}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto linear = -0.5 * dot(a.grad_rho_l + b.grad_rho_l, ab.dx);
    const auto f = -dot(ab.dx, ab.grad_w) * ab.inv_r_sq;
    return adds::row(delta * ab.h * (a.c + b.c) * (b.m / b.rho) * (b.rho - a.rho - linear) * f);
  }
};

/// What the renormalised gradient is made of; the inverse of `moment` times `grad_rho` is exact for linear fields.
struct DensityGradient {
  static constexpr Info info{
      "density_gradient", "Density gradient and first moment matrix of the kernel gradient",
      "grad rho_a = sum_b (m_b/rho_b)(rho_b - rho_a) grad_a W_ab; M_a = sum_b (m_b/rho_b)(x_b - x_a) (x) grad_a W_ab",
      "Randles & Libersky (1996); Antuono et al. (2010), eq. 11"};
  using reads = Fields<m, rho>;
  using adds = Fields<grad_rho, moment>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto volume = b.m / b.rho;
    return adds::row(volume * (b.rho - a.rho) * ab.grad_w, outer(ab.grad_w, -volume * ab.dx));
  }
};

}  // namespace undine::terms
