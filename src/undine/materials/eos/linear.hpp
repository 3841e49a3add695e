#pragma once
#include <array>
#include <cmath>

#include "undine/core/catalogue.hpp"
#include "undine/core/parameter.hpp"

namespace undine::materials {

struct Linear {
  static constexpr Info info{"linear", "Liquid with a constant speed of sound", "p = c_0^2 (rho - rho_0)",
                             "Saalfeld (2012), eq. 31; Morris et al. (1997), eq. 12"};
  double rho_0 = 1000;
  double c_0 = 30;
  static constexpr auto parameters() {
    return std::array{
        Parameter<Linear>{"sound_speed", &Linear::c_0, "m/s", "c_0, at least ten times the largest velocity", 1e-300}};
  }

  double pressure(double rho) const { return c_0 * c_0 * (rho - rho_0); }
  double sound_speed(double) const { return c_0; }
  double density(double p) const { return rho_0 + p / (c_0 * c_0); }
  double energy(double rho) const { return c_0 * c_0 * (std::log(rho / rho_0) + rho_0 / rho - 1); }
};

}  // namespace undine::materials
