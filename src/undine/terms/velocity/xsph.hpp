#pragma once
#include <array>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"

namespace undine::terms {
using namespace field;

struct Xsph {
  static constexpr Info info{"xsph", "Velocity moved towards the neighbours' mean; keeps particles in order",
                             "dv_a = epsilon sum_b m_b/((rho_a + rho_b)/2) (v_b - v_a) W_ab",
                             "Monaghan (1989); Saalfeld (2012), eq. 50"};
  using reads = Fields<m, rho, v>;
  using adds = Fields<v_xsph>;

  double epsilon = 0.5;
  static constexpr auto parameters() {
    return std::array{Parameter<Xsph>{"epsilon", &Xsph::epsilon, "1", "share of the mean that is taken over", 0, 1}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(epsilon * b.m * ab.inv_rho * ab.w * (b.v - a.v));
  }
};

}  // namespace undine::terms
