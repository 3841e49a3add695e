#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct GhostFreeSlip {
  static constexpr Info info{
      "ghost_free_slip", "The fluid mirrored at flat walls, with the normal velocity turned round",
      "x_g = x - 2 n n.(x - x_w), v_g = v - 2 n n.(v - v_w), p_g = p + rho g.(x_g - x), m_g = m; "
      "products of reflections in corners",
      "Niedoba (2012), eq. 2.77-2.78 and 3.3; Saalfeld (2012), 4.4"};
  static constexpr WallDensity density = WallDensity::copied;
  static constexpr bool reflects = true;
  static constexpr Slip slip = Slip::free;
};

}  // namespace undine::walls
