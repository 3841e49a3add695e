#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct Distance {
  static constexpr Info info{"distance", "Surfaces push back what comes nearer than a length l",
                             "f = (l - r)/dt^2 along the normal where r < l, once a step",
                             "Harada et al. (2007); Saalfeld (2012), eq. 58 and 7.3"};
  static constexpr WallDensity density = WallDensity::none;
  static constexpr WallForce force = WallForce::distance;
  static constexpr bool reflects = false;
};

}  // namespace undine::walls
