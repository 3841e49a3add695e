#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"

namespace undine::terms {
using namespace field;

// What the pressure forces of the same name take from the kinetic energy of a pair, given to its internal energy.

struct EnergySymmetric {
  static constexpr Info info{
      "symmetric", "Half of the work of pressure form `symmetric` to each of a pair: conserves energy",
      "de_a/dt = 1/2 sum_b m_b (p_a/rho_a^2 + p_b/rho_b^2) (v_a - v_b).grad_a W_ab", "Niedoba (2012), eq. 2.66"};
  using reads = Fields<m, rho, p, v>;
  using adds = Fields<de>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(0.5 * b.m * (a.p / sq(a.rho) + b.p / sq(b.rho)) * dot(a.v - b.v, ab.grad_w));
  }
};

struct EnergySum {
  static constexpr Info info{"sum", "Half of the work of pressure form `sum` to each of a pair: conserves energy",
                             "de_a/dt = 1/2 sum_b m_b (p_a + p_b)/(rho_a rho_b) (v_a - v_b).grad_a W_ab",
                             "Niedoba (2012), eq. 2.65"};
  using reads = Fields<m, rho, p, v>;
  using adds = Fields<de>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(0.5 * b.m * (a.p + b.p) / (a.rho * b.rho) * dot(a.v - b.v, ab.grad_w));
  }
};

/// Entropy stays what it is: this is p/rho^2 times the rate of density by continuity.
struct EnergyOwn {
  static constexpr Info info{"own",
                             "Work of a particle's own pressure; with pressure form `symmetric` conserves energy, and "
                             "entropy with density by continuity",
                             "de_a/dt = p_a/rho_a^2 sum_b m_b (v_a - v_b).grad_a W_ab",
                             "Monaghan (1992); Price (2012), internal energy, with Omega = 1"};
  using reads = Fields<m, rho, p, v>;
  using adds = Fields<de>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(b.m * a.p / sq(a.rho) * dot(a.v - b.v, ab.grad_w));
  }
};

/// The same for pressure form `sum` and density form `continuity_volume`.
struct EnergyOwnVolume {
  static constexpr Info info{"own_volume",
                             "Work of a particle's own pressure; with pressure form `sum` conserves energy",
                             "de_a/dt = p_a/rho_a sum_b m_b/rho_b (v_a - v_b).grad_a W_ab",
                             "Ritchie & Thomas (2001); p/rho^2 times the rate of Saalfeld (2012), eq. 37"};
  using reads = Fields<m, rho, p, v>;
  using adds = Fields<de>;

  constexpr auto operator()(const auto& a, const auto& b, const auto& ab) const {
    return adds::row(b.m * a.p / (a.rho * b.rho) * dot(a.v - b.v, ab.grad_w));
  }
};

}  // namespace undine::terms
