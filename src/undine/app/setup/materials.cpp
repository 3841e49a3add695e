#include "undine/app/setup/materials.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "undine/app/setup/start.hpp"
#include "undine/app/setup/wall_points.hpp"
#include "undine/core/error.hpp"
#include "undine/geometry/embed.hpp"

namespace undine {
namespace {

/// Potential energies per mass that particles begin with, m^2/s^2, and what fluid makes of them.
struct Start {
  double lowest = 1e300;    ///< of all particles
  double highest = -1e300;  ///< of the fluid
  double speed = 0;         ///< m/s, that the fluid begins with or can fall to
};

template <int N>
Start survey(const std::vector<Body>& bodies, const Vec<N>& gravity) {
  Start start;
  for (const Body& body : bodies) {
    const StartVelocity<N> velocity(body);
    for (std::size_t i = 0; i < body.points.size(); ++i) {
      const double level = -dot(gravity, narrow<N>(body.points[i]));
      start.lowest = std::min(start.lowest, level);
      if (body.group != Group::fluid) continue;
      start.highest = std::max(start.highest, level);
      start.speed = std::max(start.speed, norm(velocity(i)));
    }
  }
  if (start.highest > start.lowest) start.speed = std::max(start.speed, std::sqrt(2 * (start.highest - start.lowest)));
  return start;
}

/// What keeps pairs apart, if the pressure form has it: it is to stop two particles that meet at the expected speed.
template <int N>
void read_separation(const Table& scheme, CaseSetup<N>& setup) {
  auto* liquid = std::get_if<WeaklyCompressibleOptions<N>>(&setup.scheme);
  if (!liquid) return;
  liquid->pressure.with_chosen([&](auto& form) {
    if constexpr (requires { form.separation; }) {
      const Table table = scheme.table("pressure");
      form.separation = setup.choice.separation * sq(setup.expected_speed);
      form.reach = setup.choice.reach * setup.spacing;
      read_parameters(table, form);
      if (!(form.reach > 0 && form.reach <= liquid->support.uniform))
        table.fail("reach", fmt::format("pairs cannot be kept {:.4g} m apart", form.reach),
                   "it is a distance above zero, and neighbours are known up to the support radius only",
                   fmt::format("take about half a spacing, {:.4g} m", 0.5 * setup.spacing));
    }
  });
}

/// Monaghan (1994) takes D = 5 g H, H the depth of the fluid; the expected speed is sqrt(2 g H).
template <int N>
void read_repulsion(const Table& table, CaseSetup<N>& setup) {
  terms::Repulsion repulsion;
  repulsion.D = 2.5 * sq(setup.expected_speed);
  // Fluid on the lattice begins half a spacing from the surface, where it is to feel nothing.
  repulsion.r_0 = 0.5 * (setup.spacing + (repelling_shift(table) ? repelling_spacing(table, setup.spacing) : 0));
  read_parameters(table, repulsion);
  const double H = setup.options().support.uniform;
  if (!(repulsion.r_0 > 0 && repulsion.r_0 <= H))
    table.fail("r_0", fmt::format("walls cannot repel from {:.4g} m", repulsion.r_0),
               fmt::format("neighbours are known up to the support radius H = {:.4g} m only", H),
               fmt::format("take about one spacing, {:.4g} m", setup.spacing));
  for (const double p : {repulsion.p1, repulsion.p2})
    if (std::abs(2 * p - std::round(2 * p)) > 1e-9)
      table.fail(p == repulsion.p1 ? "p1" : "p2", fmt::format("the exponent {} is no multiple of 1/2", p), {},
                 "take 12 and 6, 4 and 2, or 9.5 and 4");
  if (!(repulsion.p1 > repulsion.p2))
    table.fail("p1", fmt::format("p1 = {} is not larger than p2 = {}", repulsion.p1, repulsion.p2),
               "walls would attract", "take 12 and 6, 4 and 2, or 9.5 and 4");
  setup.options().repulsion = repulsion;
}

/// What evens out densities knows one at rest: between liquids of two it would take away what tells them apart.
void refuse_fluids(const Table& scheme, const std::vector<materials::Material>& materials, std::string_view key,
                   std::string_view what) {
  for (const auto& material : materials)
    if (material.rho_0 != materials.front().rho_0)
      scheme.fail(
          key,
          fmt::format("{} between '{}' and '{}', which differ in density", what, materials.front().name, material.name),
          "it would mix their densities, not their noise", fmt::format("set scheme.{}.form = \"none\"", key));
}

}  // namespace

template <int N>
void read_materials(const Table& root, const std::vector<Body>& bodies, const CaseWalls<N>& walls,
                    CaseSetup<N>& setup) {
  const auto& g = setup.options().gravity;
  const Start start = survey(bodies, g);
  if (!root.has("expected_speed") && walls.fastest > 1.0001 * start.speed)
    throw InputError({.what = "walls move faster than the fluid would by itself",
                      .where = root.where("wall"),
                      .why = fmt::format("they reach {:.4g} m/s until time.end; gravity and the initial velocities "
                                         "give {:.4g} m/s, from which the speed of sound would follow",
                                         walls.fastest, start.speed),
                      .fix = fmt::format("set expected_speed, such as {:.4g} (m/s)", walls.fastest)});
  setup.expected_speed = root.positive("expected_speed", unit::velocity, std::max(start.speed, 1e-6));
  const Table scheme = root.table("scheme");
  read_separation(scheme, setup);
  if (setup.choice.wall_force == walls::WallForce::repulsion) read_repulsion(walls.treatment, setup);
  auto& materials = setup.options().materials;
  for (const Body& body : bodies)
    if (body.group == Group::fluid)
      materials.push_back(read_material(body.table, setup.choice, setup.expected_speed, setup.warnings));
  const auto* liquid = std::get_if<WeaklyCompressibleOptions<N>>(&setup.scheme);
  if (liquid && liquid->diffusion) refuse_fluids(scheme, materials, "density_diffusion", "density diffusion acts");
  if (liquid && liquid->density_filter) refuse_fluids(scheme, materials, "density_filter", "the density filter acts");
  // E_pot counts from the lowest place that fluid or wall reaches.
  const double g_sq = norm_sq(g);
  if (g_sq > 0) setup.potential_origin = -(start.lowest / g_sq) * g;
}

template void read_materials(const Table&, const std::vector<Body>&, const CaseWalls<1>&, CaseSetup<1>&);
template void read_materials(const Table&, const std::vector<Body>&, const CaseWalls<2>&, CaseSetup<2>&);
template void read_materials(const Table&, const std::vector<Body>&, const CaseWalls<3>&, CaseSetup<3>&);

}  // namespace undine
