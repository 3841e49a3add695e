#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct Elastic {
  static constexpr Info info{"elastic", "Particles bounce off the surface like billiard balls",
                             "x and v mirrored at the surface, several times in corners",
                             "Saalfeld (2012), 4.1 and 7.2"};
  static constexpr WallDensity density = WallDensity::none;
  static constexpr bool reflects = true;
};

}  // namespace undine::walls
