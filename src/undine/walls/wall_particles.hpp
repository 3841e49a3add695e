#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct WallParticles {
  static constexpr Info info{"wall_particles", "Fixed particles whose density and pressure follow the fluid equations",
                             "drho_w/dt by continuity, p_w = p(rho_w)",
                             "Dalrymple & Knio (2001); Saalfeld (2012), 4.2 and 7.3"};
  static constexpr WallDensity density = WallDensity::evolved;
  static constexpr bool reflects = false;
};

}  // namespace undine::walls
