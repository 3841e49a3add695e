#pragma once

namespace undine::walls {

/// How wall particles come by their density, from which the equation of state makes the pressure that they answer with.
enum class WallDensity {
  none,     ///< there are no wall particles
  evolved,  ///< by continuity, as fluid
  modified  ///< reference density plus the sum over the fluid: Saalfeld (2012), eq. 70
};

}  // namespace undine::walls
