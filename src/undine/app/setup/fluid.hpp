#pragma once
#include "undine/app/setup/body.hpp"

namespace undine {

/// The particles of a [[fluid]]: on a lattice in its shape, shaken or not, or from a list. `number`: of the fluid among
/// the case's, whose finest `spacing` (m) is. Throws InputError.
Body read_fluid(const Table& table, int number, double spacing, int dimensions);

}  // namespace undine
