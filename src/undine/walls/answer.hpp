#pragma once

namespace undine::walls {

/// How wall particles come by their density, from which the equation of state makes the pressure that they answer with.
enum class WallDensity {
  none,         ///< there are no wall particles
  evolved,      ///< by continuity, as fluid
  modified,     ///< reference density plus the sum over the fluid: Saalfeld (2012), eq. 70
  extrapolated  ///< from the pressure of the fluid, carried to the wall: Adami et al. (2012)
};

}  // namespace undine::walls
