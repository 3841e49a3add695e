#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/value.hpp"

namespace undine::terms {
using namespace field;

struct SignalSpeed {
  static constexpr Info info{"signal_speed", "Largest speed of a signal between neighbours, for steps and switches",
                             "v_sig_a = max_b ((c_a + c_b)/2 - min(0, v_ab.r_ab/|r_ab|))",
                             "Cullen & Dehnen (2010), signal velocity; Monaghan (1997)"};
  using reads = Fields<v, c>;
  using adds = Fields<v_signal>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(0.5 * (a.c + b.c) - negative_part(dot(a.v - b.v, ab.dx)) * ab.r * ab.inv_r_sq);
  }
};

}  // namespace undine::terms
