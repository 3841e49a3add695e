#pragma once
#include "undine/app/setup/body.hpp"

namespace undine {

/// Gives a body the particles of the file that its key `particles` names: comma-separated values (.csv) or a snapshot,
/// of which those of the body's group are taken. Throws InputError with the place in the list or, where a list has
/// none, in the case.
void take_particle_list(Body& body, int dimensions);

}  // namespace undine
