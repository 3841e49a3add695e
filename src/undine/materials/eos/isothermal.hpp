#pragma once
#include <array>
#include <cmath>

#include "undine/core/catalogue.hpp"
#include "undine/core/parameter.hpp"

namespace undine::materials {

struct Isothermal {
  static constexpr Info info{"isothermal", "Artificial compressibility: pressure proportional to density",
                             "p = c_0^2 rho", "Niedoba (2012), eq. 2.74"};
  double rho_0 = 1000;
  double c_0 = 30;
  static constexpr auto parameters() {
    return std::array{Parameter<Isothermal>{"sound_speed", &Isothermal::c_0, "m/s", "c_0", 1e-300}};
  }

  double pressure(double rho) const { return c_0 * c_0 * rho; }
  double sound_speed(double) const { return c_0; }
  double density(double p) const { return p / (c_0 * c_0); }
  double energy(double rho) const { return c_0 * c_0 * std::log(rho / rho_0); }
};

}  // namespace undine::materials
