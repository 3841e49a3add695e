#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/value.hpp"

namespace undine::terms {
using namespace field;

struct ApproachSpeed {
  static constexpr Info info{"approach_speed", "Largest rate of strain between neighbours, for the step size",
                             "mu_a = max_b h |v_ab.r_ab|/(r^2 + 0.01 h^2)", "Monaghan (1992), eq. 10.5"};
  using reads = Fields<v>;
  using adds = Fields<mu_cfl>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(abs(dot(a.v - b.v, ab.dx)) * ab.h * ab.inv_r_sq);
  }
};

}  // namespace undine::terms
