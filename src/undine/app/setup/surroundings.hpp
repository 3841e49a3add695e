#pragma once
#include <vector>

#include "undine/app/case_setup.hpp"
#include "undine/app/setup/body.hpp"
#include "undine/app/setup/wall.hpp"

namespace undine {

/// Tells the flow what it meets besides particles while it runs: imposed forces, where its walls are at which time,
/// what reflects, what pushes and what mirrors. The store must be filled. Throws InputError.
template <int N>
void connect_surroundings(const Table& root, const std::vector<Body>& bodies, const CaseWalls<N>& walls,
                          CaseSetup<N>& setup);

}  // namespace undine
