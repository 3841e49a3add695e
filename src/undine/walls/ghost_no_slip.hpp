#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct GhostNoSlip {
  static constexpr Info info{"ghost_no_slip", "The fluid mirrored at flat walls, with all of the velocity turned round",
                             "as `ghost_free_slip`, with v_g = 2 v_w - v",
                             "Niedoba (2012), 2.2.5; Saalfeld (2012), 4.4"};
  static constexpr WallDensity density = WallDensity::copied;
  static constexpr bool reflects = true;
  static constexpr Slip slip = Slip::none;
};

}  // namespace undine::walls
