#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct Adami {
  static constexpr Info info{
      "adami", "Fixed particles that answer the pressure of the fluid before them, carried to their place",
      "p_w = sum_f V_f (p_f + rho_f g.(x_w - x_f)) W_wf / sum_f V_f W_wf, rho_w = rho(p_w)",
      "Adami et al. (2012), eq. 27"};
  static constexpr WallDensity density = WallDensity::extrapolated;
  static constexpr bool reflects = false;
};

}  // namespace undine::walls
