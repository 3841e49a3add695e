#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "undine/app/case_scheme.hpp"
#include "undine/engine/store.hpp"

namespace undine {

/// Gives a wall particle the state of the gas nearest to it, among `near`, numbers within the fluid.
template <int N>
void hold_gas(Store<N>& store, const Domain<N>& domain, std::size_t wall_particle,
              const std::vector<std::uint32_t>& near) {
  const std::size_t first = store.range(Group::fluid).begin;
  const auto x = store.template get<field::x>();
  const auto far = [&](std::uint32_t j) { return norm_sq(domain.nearest_image(x[first + j] - x[wall_particle])); };
  const auto nearest = std::ranges::min_element(near, {}, far);
  if (nearest == near.end()) return;
  const std::size_t gas = first + *nearest;
  for (const int f : {field::rho::id, field::e::id, field::m::id, field::rho_0::id})
    store.raw(f)[wall_particle] = store.raw(f)[gas];
  store.materials()[wall_particle] = store.materials()[gas];
}

/// How far apart particles that repel lie, m: closer than those of the fluid they make a smoother wall. Throws
/// InputError at the key.
inline double repelling_spacing(const Table& wall, double spacing) {
  const double own = wall.positive("spacing", unit::length, spacing);
  if (own < 0.5 * (1 - 1e-9) * spacing || own > spacing * (1 + 1e-9))
    wall.fail("spacing", fmt::format("particles that repel cannot lie {:.4g} m apart", own),
              fmt::format("the case's spacing is {:.4g} m", spacing), "take half of that to all of it");
  return own;
}

}  // namespace undine
