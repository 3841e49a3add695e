#pragma once

namespace undine::walls {

/// How wall particles come by their density, from which the equation of state makes the pressure that they answer with.
enum class WallDensity {
  none,          ///< there are no wall particles
  evolved,       ///< by continuity, as fluid
  modified,      ///< reference density plus the sum over the fluid: Saalfeld (2012), eq. 70
  extrapolated,  ///< from the pressure of the fluid, carried to the wall: Adami et al. (2012)
  mirrored       ///< that of the fluid particle whose ghost it is
};

/// What a ghost does with the velocity of its parent, relative to the wall.
enum class Slip {
  free,  ///< turns the part along the wall's normal round
  none   ///< turns all of it round
};

}  // namespace undine::walls
