#pragma once
#include <vector>

#include "undine/app/case_setup.hpp"
#include "undine/app/setup/body.hpp"

namespace undine {

/// Places the domain: as [domain] says, or with room around all particles and the container, far enough up for
/// splashes. Throws InputError where it is empty or too short for its periods.
template <int N>
void place_domain(const Table& root, const std::vector<Body>& bodies, CaseSetup<N>& setup);

/// What becomes of fluid that would leave the domain, as [domain] says; returns whether it is reflected.
template <int N>
bool read_escape(const Table& root, FlowOptions<N>& options);

}  // namespace undine
