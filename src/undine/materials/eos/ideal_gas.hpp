#pragma once
#include <array>
#include <cmath>

#include "undine/core/catalogue.hpp"
#include "undine/core/parameter.hpp"

namespace undine::materials {

/// The only one whose pressure depends on the internal energy e. Functions of density alone are those of the isentrope
/// through (rho_0, e_0), for schemes without an energy equation.
struct IdealGas {
  static constexpr Info info{"ideal_gas", "Ideal gas with constant ratio of specific heats",
                             "p = (gamma - 1) rho e, c^2 = gamma p/rho", "Niedoba (2012), eq. 2.18 and 2.73"};
  double rho_0 = 1;
  double gamma = 1.4;
  double e_0 = 2.5;
  static constexpr auto parameters() {
    using P = Parameter<IdealGas>;
    return std::array{
        P{"gamma", &IdealGas::gamma, "1", "ratio of specific heats", 1.000001, 10},
        P{"reference_energy", &IdealGas::e_0, "J/kg", "e at rho_0 where no energy equation is solved", 1e-300}};
  }

  double pressure(double rho, double e) const { return (gamma - 1) * rho * e; }
  double sound_speed(double, double e) const { return std::sqrt(gamma * (gamma - 1) * e); }
  double internal_energy(double rho, double p) const { return p / ((gamma - 1) * rho); }

  double isentropic_energy(double rho) const { return e_0 * std::pow(rho / rho_0, gamma - 1); }
  double pressure(double rho) const { return pressure(rho, isentropic_energy(rho)); }
  double sound_speed(double rho) const { return sound_speed(rho, isentropic_energy(rho)); }
  double density(double p) const { return rho_0 * std::pow(p / pressure(rho_0), 1 / gamma); }
  double energy(double rho) const { return isentropic_energy(rho) - e_0; }
};

}  // namespace undine::materials
