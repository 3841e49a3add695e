#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

struct Summation {
  static constexpr Info info{"summation", "Density summed over the neighbours, itself included",
                             "rho_a = sum_b m_b W_ab",
                             "Gingold & Monaghan (1977); Saalfeld (2012), eq. 34; Niedoba (2012), eq. 2.57"};
  using reads = Fields<m>;
  using adds = Fields<rho_sum>;

  constexpr auto operator()(const auto&, const auto& b, const auto& ab) const { return adds::row(b.m * ab.w); }
};

struct ShepardSum {
  static constexpr Info info{"shepard_sum", "Sum of the neighbours' volumes, the norm of a Shepard mean",
                             "s_a = sum_b (m_b/rho_b) W_ab", "Shepard (1968); Niedoba (2012), eq. 2.58"};
  using reads = Fields<m, rho>;
  using adds = Fields<w_sum>;

  constexpr auto operator()(const auto&, const auto& b, const auto& ab) const { return adds::row(b.m / b.rho * ab.w); }
};

}  // namespace undine::terms
