#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct None {
  static constexpr Info info{"none", "No wall: free or periodic boundaries only", "-", "-"};
  static constexpr WallDensity density = WallDensity::none;
  static constexpr bool reflects = false;
};

}  // namespace undine::walls
