#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct ModifiedDensity {
  static constexpr Info info{"modified_density", "Fixed particles that answer the sum of the fluid around them",
                             "rho_w = rho_wref + sum_fluid m_b W_wb, p_w = p(rho_w)", "Saalfeld (2012), eq. 70"};
  static constexpr WallDensity density = WallDensity::modified;
  static constexpr bool reflects = false;
};

}  // namespace undine::walls
