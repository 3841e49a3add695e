#include "undine/app/setup/wall.hpp"

#include <fmt/format.h>

#include "undine/app/case_shapes.hpp"
#include "undine/app/setup/particle_list.hpp"
#include "undine/app/setup/wall_motion.hpp"
#include "undine/app/setup/wall_points.hpp"

namespace undine {
namespace {

constexpr int no_body = -1;  ///< number of a wall that has no particles of its own, but ghosts

template <int N>
FaceSet read_open_faces(const Table& table) {
  const std::vector<std::string> faces{"x-", "x+", "y-", "y+", "z-", "z+"};
  return parse_faces(table.choices("open", {faces.begin(), faces.begin() + 2 * N}, {}));
}

template <int N>
std::size_t add_surface(ReflectingSurface& surface, const WallShape& wall, double restitution) {
  const auto box = wall.shape->as_box();
  if (box && wall.fluid == Side::inside) return surface.add_tank(*box, N, wall.open, restitution);
  return surface.add(wall.shape, wall.fluid, restitution);
}

/// The number of the wall's motion in the options; -1 where it stands still.
template <int N>
int read_motion(const Table& table, const std::vector<PlacedSurface>& placed, CaseSetup<N>& setup, double& fastest) {
  auto motion = read_wall_motion<N>(table, setup.choice, placed, fastest);
  if (!motion) return -1;
  auto& motions = setup.options().walls.motions;
  motions.push_back(std::move(*motion));
  return static_cast<int>(motions.size()) - 1;
}

void refuse_motion(const Table& table) {
  for (const char* key : {"displacement", "slide"})
    if (table.has(key))
      table.fail(key, "walls with ghosts do not move", "their mirrors stand still",
                 "choose another treatment, such as 'adami' or 'mdbc'");
}

}  // namespace

template <int N>
std::optional<Body> read_wall(const Table& table, std::size_t number, CaseSetup<N>& setup, CaseWalls<N>& walls) {
  const SchemeChoice& choice = setup.choice;
  Body body{table.text("name", fmt::format("wall{}", number)), Group::wall, 0, {}, {}, table};
  const Table shape_table = table.table("shape");
  WallShape wall;
  wall.fluid = table.choice("fluid", {"inside", "outside"}, "inside") == "inside" ? Side::inside : Side::outside;
  wall.open = read_open_faces<N>(table);
  const bool has_list = table.has("particles");
  const bool reflects = choice.reflects && table.flag("reflects", true);
  const bool pushes = choice.wall_force == walls::WallForce::distance;
  if (!has_list || shape_table.exists()) wall.shape = read_shape(shape_table, N);
  if (!wall.shape && (pushes || setup.options().wall_density == walls::WallDensity::mirrored))
    table.fail("particles", "this wall has no shape", "its treatment needs to know where the surface is",
               "add the shape on whose surface the particles lie, or choose another treatment");

  std::vector<PlacedSurface> placed;
  const auto add_to = [&](const std::shared_ptr<ReflectingSurface>& surface) {
    placed.push_back({surface, add_surface<N>(*surface, wall, choice.restitution)});
  };
  if (wall.shape && reflects) add_to(walls.reflecting);
  if (wall.shape && pushes) add_to(walls.pushing);
  const bool may_move = !placed.empty() || choice.wall_particles;
  if (wall.shape) add_to(walls.all);
  if (choice.ghosts) {
    refuse_motion(table);
  } else if (may_move) {
    body.motion = read_motion(table, placed, setup, walls.fastest);
  }
  if (wall.shape) {
    body.surface = std::make_shared<ReflectingSurface>();
    add_surface<N>(*body.surface, wall, choice.restitution);
  }

  if (choice.ghosts) {
    if (!wall.shape) wall.shape = read_shape(shape_table, N);  // says that it is missing
    if (!reflects)
      table.fail("reflects", "walls with ghosts reflect", "a particle behind one would have its ghost in the fluid",
                 "leave 'reflects' out");
    walls.ghosts.add(table, body.name, *wall.shape, wall.fluid, wall.open);
    if (!setup.bodies.emplace(body.name, no_body).second)
      table.fail("name", fmt::format("two bodies are named '{}'", body.name), {}, "give each its own name");
  }
  if (wall.shape && wall.fluid == Side::inside) setup.container.include(wall.shape->bounds());
  leave_unused(table, {"reflects", "sheet", "layers", "thin"});
  if (has_list) {
    take_particle_list(body, N);
  } else if (choice.wall_particles) {
    body.points = wall_points(table, wall, walls.treatment, setup);
  }
  if (!choice.wall_particles) return {};
  return body;
}

template std::optional<Body> read_wall(const Table&, std::size_t, CaseSetup<1>&, CaseWalls<1>&);
template std::optional<Body> read_wall(const Table&, std::size_t, CaseSetup<2>&, CaseWalls<2>&);
template std::optional<Body> read_wall(const Table&, std::size_t, CaseSetup<3>&, CaseWalls<3>&);

}  // namespace undine
