#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct WallExtrapolation {
  static constexpr Info info{
      "wall_extrapolation", "Pressure of the fluid carried hydrostatically to a wall particle, and its weight",
      "p_w = sum_f V_f (p_f + rho_f g.(x_w - x_f)) W_wf / sum_f V_f W_wf", "Adami et al. (2012), eq. 27"};
  using reads = Fields<m, rho, p>;
  using target_reads = Fields<>;  // of the wall particle only its place
  using adds = Fields<p_sum, w_sum>;

  Vec<3> gravity;  ///< less the wall's own acceleration, m/s^2; set by the scheme

  constexpr auto operator()(const auto&, const auto& b, const auto& ab) const {
    auto g_dx = gravity[0] * ab.dx[0];
    for (int k = 1; k < ab.dim; ++k) g_dx = g_dx + gravity[k] * ab.dx[k];
    const auto weight = b.m / b.rho * ab.w;
    return adds::row(weight * (b.p + b.rho * g_dx), weight);
  }
};

/// What an accelerated wall adds to the extrapolated pressure: - a_w . s_w / sum_f V_f W_wf.
struct WallMoment {
  static constexpr Info info{"wall_moment", "Where the fluid around a wall particle lies, for walls that accelerate",
                             "s_w = sum_f m_f (x_w - x_f) W_wf", "Adami et al. (2012), eq. 27"};
  using reads = Fields<m>;
  using target_reads = Fields<>;
  using adds = Fields<dx_sum>;

  constexpr auto operator()(const auto&, const auto& b, const auto& ab) const { return adds::row(b.m * ab.w * ab.dx); }
};

}  // namespace undine::terms
