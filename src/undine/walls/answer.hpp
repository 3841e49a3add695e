#pragma once

namespace undine::walls {

/// How wall particles come by their density, from which the equation of state makes the pressure that they answer with.
enum class WallDensity {
  none,          ///< there are no wall particles
  evolved,       ///< by continuity, as fluid
  modified,      ///< reference density plus the sum over the fluid: Saalfeld (2012), eq. 70
  extrapolated,  ///< from the pressure of the fluid, carried to the wall: Adami et al. (2012)
  mirrored,      ///< from the density of the fluid at the mirror image, carried to the wall: English et al. (2022)
  copied,        ///< that of the fluid particle whose ghost it is
  held           ///< that of the gas nearest at the start, for good, as its internal energy
};

/// What a ghost does with the velocity of its parent, relative to the wall.
enum class Slip {
  free,  ///< turns the part along the wall's normal round
  none   ///< turns all of it round
};

/// What walls do to fluid besides answering with a density.
enum class WallForce {
  none,
  distance,  ///< the surface pushes what comes nearer than a length: Saalfeld (2012), eq. 58
  repulsion  ///< particles on the surface repel: Saalfeld (2012), eq. 59
};

/// The force of an entry of the list; an entry that names none has none.
template <class Entry>
constexpr WallForce force_of() {
  if constexpr (requires { Entry::force; }) {
    return Entry::force;
  } else {
    return WallForce::none;
  }
}

}  // namespace undine::walls
