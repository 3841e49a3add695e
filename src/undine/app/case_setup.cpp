#include "undine/app/case_setup.hpp"

#include "undine/app/setup/checks.hpp"
#include "undine/app/setup/domain.hpp"
#include "undine/app/setup/fluid.hpp"
#include "undine/app/setup/materials.hpp"
#include "undine/app/setup/start.hpp"
#include "undine/app/setup/surroundings.hpp"
#include "undine/app/setup/wall.hpp"
#include "undine/app/setup/wall_start.hpp"
#include "undine/core/error.hpp"

namespace undine {
namespace {

std::vector<Body> read_fluids(const Table& root, double spacing, int dimensions) {
  std::vector<Body> fluids;
  for (const Table& table : root.tables("fluid"))
    fluids.push_back(read_fluid(table, static_cast<int>(fluids.size()), spacing, dimensions));
  if (fluids.empty())
    throw InputError({.what = "the case has no fluid",
                      .where = root.where(),
                      .why = "nothing would move",
                      .fix = "add a [[fluid]] with a shape"});
  return fluids;
}

/// Walls, of which those with particles become bodies.
template <int N>
CaseWalls<N> read_walls(const Table& root, CaseSetup<N>& setup, std::vector<Body>& bodies) {
  CaseWalls<N> walls{root.table("scheme").table("wall")};
  std::size_t number = bodies.size();
  for (const Table& table : root.tables("wall"))
    if (auto body = read_wall(table, number++, setup, walls)) bodies.push_back(std::move(*body));
  return walls;
}

}  // namespace

template <int N>
CaseSetup<N> read_case(const Table& root) {
  CaseSetup<N> setup;
  setup.title = root.text("title", "");
  setup.spacing = root.positive("spacing", unit::length);
  setup.choice = read_scheme<N>(root, setup.spacing, setup.scheme);
  std::vector<Body> bodies = read_fluids(root, setup.spacing, N);
  CaseWalls<N> walls = read_walls(root, setup, bodies);
  note_names(bodies, setup.bodies);
  place_domain(root, bodies, setup);
  walls.domain_reflects = read_escape(root, setup.options());
  check_inside(root, bodies, setup.domain);
  check_overlaps(bodies, setup.domain, setup.spacing);
  read_materials(root, bodies, walls, setup);
  fill_store(bodies, setup);
  start_walls(bodies, setup);
  connect_surroundings(root, bodies, walls, setup);
  setup.walls = walls.all;
  return setup;
}

template CaseSetup<1> read_case<1>(const Table&);
template CaseSetup<2> read_case<2>(const Table&);
template CaseSetup<3> read_case<3>(const Table&);

}  // namespace undine
