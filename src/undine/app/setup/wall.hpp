#pragma once
#include <memory>
#include <optional>

#include "undine/app/case_setup.hpp"
#include "undine/app/setup/body.hpp"
#include "undine/app/setup/ghosts.hpp"

namespace undine {

/// What the walls of a case are besides particles.
template <int N>
struct CaseWalls {
  Table treatment;  ///< [scheme.wall]
  std::shared_ptr<ReflectingSurface> all = std::make_shared<ReflectingSurface>();
  std::shared_ptr<ReflectingSurface> reflecting = std::make_shared<ReflectingSurface>();
  std::shared_ptr<ReflectingSurface> pushing = std::make_shared<ReflectingSurface>();
  bool domain_reflects = false;  ///< as a wall would that stood around all
  GhostWalls<N> ghosts = {};
  double fastest = 0;  ///< m/s, until time.end
};

/// Adds a [[wall]] to the others, and what the set-up knows of it: its motion, the name of a wall with ghosts, the
/// container. Returns its particles, where the treatment has such. `number`: of the body among the case's. Throws
/// InputError.
template <int N>
std::optional<Body> read_wall(const Table& table, std::size_t number, CaseSetup<N>& setup, CaseWalls<N>& walls);

}  // namespace undine
