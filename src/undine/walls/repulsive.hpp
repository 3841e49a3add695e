#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct Repulsive {
  static constexpr Info info{"repulsive", "One layer of particles that repel and take no part in density and pressure",
                             "f = D ((r_0/r)^p1 - (r_0/r)^p2) r/r^2 where r < r_0",
                             "Monaghan (1994); Saalfeld (2012), eq. 59; Niedoba (2012), eq. 2.76"};
  static constexpr WallDensity density = WallDensity::none;
  static constexpr WallForce force = WallForce::repulsion;
  static constexpr bool reflects = false;
};

}  // namespace undine::walls
