#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/value.hpp"

namespace undine::terms {
using namespace field;

// Artificial viscosity of gases. Each particle brings its alpha (constant, or set by a switch) and a limiter f
// (`balsara`); a pair takes the means. What the force takes from the motion of a pair heats it, half to each:
//   dv_a/dt = - sum_b m_b Pi_ab grad_a W_ab,   de_a/dt = 1/2 sum_b m_b Pi_ab (v_a - v_b).grad_a W_ab

namespace detail {
/// Force and heat by the speed of approach, mu_ab <= 0:
///   Pi_ab = f_ab (-alpha_ab c mu_ab + beta mu_ab^2)/rho
template <class Adds>
constexpr auto viscous_pair(const auto& mu_ab, double beta, const auto& a, const auto& b, const auto& ab) {
  const auto alpha_c = 0.25 * (a.alpha_v + b.alpha_v) * (a.c + b.c);
  const auto pi_ab = 0.5 * (a.balsara + b.balsara) * (beta * sq(mu_ab) - alpha_c * mu_ab) * ab.inv_rho;
  return Adds::row(-b.m * pi_ab * ab.grad_w, 0.5 * b.m * pi_ab * dot(a.v - b.v, ab.grad_w));
}
}  // namespace detail

struct GasViscositySignal {
  static constexpr Info info{
      "signal", "Artificial viscosity by the signal speed of the pair, active on approach, with its heat",
      "Pi_ab = f_ab (-alpha_ab c w_ab + beta w_ab^2)/rho, w_ab = min(0, v_ab.r_ab/|r_ab|), alpha, f, c and rho means",
      "Monaghan (1997), signal velocity; Price et al. (2018), shock capturing"};
  using reads = Fields<m, rho, c, v, alpha_v, balsara>;
  using adds = Fields<acc, de>;

  double alpha = 1;
  double beta = 2;
  static constexpr auto parameters() {
    using P = Parameter<GasViscositySignal>;
    return std::array{
        P{"alpha", &GasViscositySignal::alpha, "1", "strength of the linear part, unless a switch sets it", 0},
        P{"beta", &GasViscositySignal::beta, "1", "strength of the quadratic part, which keeps streams apart", 0}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto w_ab = negative_part(dot(a.v - b.v, ab.dx)) * ab.r * ab.inv_r_sq;
    return detail::viscous_pair<adds>(w_ab, beta, a, b, ab);
  }
};

struct GasViscosityMonaghan {
  static constexpr Info info{
      "monaghan", "Monaghan's artificial viscosity, active on approach, with its heat",
      "Pi_ab = f_ab (-alpha_ab c mu_ab + beta mu_ab^2)/rho, mu_ab = h min(0, v_ab.r_ab)/(r^2 + 0.01 h^2), alpha, f, c "
      "and rho means",
      "Niedoba (2012), eq. 2.70-2.72; Monaghan (1992); f: Balsara (1995)"};
  using reads = Fields<m, rho, c, v, alpha_v, balsara>;
  using adds = Fields<acc, de>;

  double alpha = 1;
  double beta = 2;
  static constexpr auto parameters() {
    using P = Parameter<GasViscosityMonaghan>;
    return std::array{
        P{"alpha", &GasViscosityMonaghan::alpha, "1", "strength of the linear part, unless a switch sets it", 0},
        P{"beta", &GasViscosityMonaghan::beta, "1", "strength of the quadratic part, which keeps streams apart", 0}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    const auto mu_ab = ab.h * negative_part(dot(a.v - b.v, ab.dx)) * ab.inv_r_sq;
    return detail::viscous_pair<adds>(mu_ab, beta, a, b, ab);
  }
};

}  // namespace undine::terms
