#pragma once
#include <array>
#include <cmath>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/value.hpp"

namespace undine::terms {
using namespace field;

/// The factor of the masses is 1 between equal ones, and makes the forces of a pair opposite for others.
struct Repulsion {
  static constexpr Info info{"repulsion", "Repulsion by wall particles nearer than r_0, of the Lennard-Jones kind",
                             "dv_a/dt = sum_w 2 m_w/(m_a + m_w) D ((r_0/r)^p1 - (r_0/r)^p2) r_aw/r^2 where r < r_0",
                             "Monaghan (1994); Saalfeld (2012), eq. 59; Niedoba (2012), eq. 2.76 (which prints the "
                             "condition the wrong way round); masses as in Monaghan & Kajtar (2009)"};
  using reads = Fields<m>;
  using adds = Fields<acc_wall>;

  double D = 1;
  double r_0 = 1;
  double p1 = 12;
  double p2 = 6;
  static constexpr auto parameters() {
    using P = Parameter<Repulsion>;
    return std::array{
        P{"D", &Repulsion::D, "m^2/s^2", "strength", 0},
        P{"r_0", &Repulsion::r_0, "m", "distance below which it acts", 0},
        P{"p1", &Repulsion::p1, "1", "exponent of the repulsion, a multiple of 1/2", 0.5, 12},
        P{"p2", &Repulsion::p2, "1", "exponent of the attraction that ends it, a multiple of 1/2", 0.5, 12}};
  }

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    using V = std::remove_cvref_t<decltype(ab.r)>;
    const V r = max(ab.r, V(0.01 * r_0));  // keeps powers within the range of a float
    const V root = sqrt(V(r_0) / r);
    const V rise = power(root, std::lround(2 * p1)) - power(root, std::lround(2 * p2));
    const V acts = select(ab.inside, select(ab.r < V(r_0), rise, V(0)), V(0));
    return adds::row(2.0 * b.m / (a.m + b.m) * D * acts / (r * r) * ab.dx);
  }

  template <class V>
  static constexpr V power(V base, long exponent) {
    V result(1);
    for (; exponent > 0; exponent /= 2) {
      if (exponent % 2 == 1) result = result * base;
      base = base * base;
    }
    return result;
  }
};

}  // namespace undine::terms
