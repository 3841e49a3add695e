#pragma once
#include <array>
#include <cmath>

#include "undine/core/catalogue.hpp"
#include "undine/core/parameter.hpp"
#include "undine/materials/power.hpp"

namespace undine::materials {

struct Tait {
  static constexpr Info info{"tait", "Stiff liquid, given by a reference pressure",
                             "p = p_ref ((rho/rho_0)^gamma - 1), c_0^2 = gamma p_ref/rho_0",
                             "Tait (1888); Saalfeld (2012), eq. 32; Niedoba (2012), eq. 2.75"};
  double rho_0 = 1000;
  double p_ref = 101300;
  double gamma = 7;
  static constexpr auto parameters() {
    using P = Parameter<Tait>;
    return std::array{P{"reference_pressure", &Tait::p_ref, "Pa", "p_ref, sets the stiffness", 1e-300},
                      P{"gamma", &Tait::gamma, "1", "exponent", 1}};
  }

  double pressure(double rho) const { return p_ref * (power(rho / rho_0, gamma) - 1); }
  /// dp/drho = c^2.
  double sound_speed(double rho) const { return std::sqrt(gamma * p_ref / rho_0 * power(rho / rho_0, gamma - 1)); }
  /// Inverse of `pressure`; not a number below the smallest pressure -p_ref.
  double density(double p) const { return rho_0 * std::pow(p / p_ref + 1, 1 / gamma); }
  /// Specific elastic energy, the integral of p/rho^2 from rho_0.
  double energy(double rho) const {
    if (gamma == 1) return p_ref / rho_0 * (std::log(rho / rho_0) + rho_0 / rho - 1);
    return p_ref / rho_0 * ((power(rho / rho_0, gamma - 1) - 1) / (gamma - 1) + rho_0 / rho - 1);
  }
};

}  // namespace undine::materials
