#pragma once
// What bodies must obey between them, before they become particles of one store. All throw InputError.
#include <map>
#include <string>
#include <vector>

#include "undine/app/setup/body.hpp"
#include "undine/core/domain.hpp"

namespace undine {

/// Notes the numbers of walls by their names; no two bodies may have the same.
void note_names(const std::vector<Body>& bodies, std::map<std::string, int>& walls);

/// Every particle within the domain.
template <int N>
void check_inside(const Table& root, const std::vector<Body>& bodies, const Domain<N>& domain);

/// Every particle once within each period, and none on another; `spacing` in m.
template <int N>
void check_overlaps(const std::vector<Body>& bodies, const Domain<N>& domain, double spacing);

}  // namespace undine
