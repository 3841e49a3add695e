#pragma once
#include "undine/core/catalogue.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

struct Mdbc {
  static constexpr Info info{
      "mdbc", "Modified dynamic boundary: particles that answer the density of the fluid at their mirror image",
      "rho_w = rho_g + (x_w - x_g).grad rho_g, rho and grad rho at the mirror image x_g by corrected interpolation",
      "English et al. (2022), eq. 10-15; Liu & Liu (2006)"};
  static constexpr WallDensity density = WallDensity::mirrored;
  static constexpr bool reflects = false;
};

}  // namespace undine::walls
