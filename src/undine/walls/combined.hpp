#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct Combined {
  static constexpr Info info{"combined", "Modified density against pressure, elastic reflection against leaks",
                             "`modified_density` and `elastic` together", "Saalfeld (2012), 7.4"};
  static constexpr WallDensity density = WallDensity::modified;
  static constexpr bool reflects = true;
};

}  // namespace undine::walls
