#pragma once
#include <vector>

#include "undine/app/case_setup.hpp"
#include "undine/app/setup/body.hpp"
#include "undine/app/setup/wall.hpp"

namespace undine {

/// The speed to expect of a case, what follows from it (what keeps pairs apart, what repels from walls), its materials,
/// and where potential energy counts from. Throws InputError.
template <int N>
void read_materials(const Table& root, const std::vector<Body>& bodies, const CaseWalls<N>& walls, CaseSetup<N>& setup);

}  // namespace undine
