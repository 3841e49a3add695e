#pragma once
#include <vector>

#include "undine/app/case_setup.hpp"
#include "undine/app/setup/body.hpp"

namespace undine {

/// The state of the store's wall particles beside fluid at rest: walls that touch fluid begin with its pressure there,
/// as a tank at rest would ring without.
template <int N>
void start_walls(const std::vector<Body>& bodies, CaseSetup<N>& setup);

}  // namespace undine
