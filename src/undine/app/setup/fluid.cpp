#include "undine/app/setup/fluid.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "undine/app/case_shapes.hpp"
#include "undine/app/setup/filling.hpp"
#include "undine/app/setup/particle_list.hpp"
#include "undine/geometry/fill.hpp"

namespace undine {
namespace {

/// Displaces points by up to `amount` in each coordinate, the same for the same seed on every machine.
void shake(std::vector<Vec3>& points, int dimensions, double amount, std::uint64_t seed) {
  std::uint64_t state = seed * 0x9e3779b97f4a7c15ULL + 1;
  for (auto& p : points)
    for (int k = 0; k < dimensions; ++k) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      p[k] += amount * (static_cast<double>(state >> 11) * 0x1p-52 - 1.0);
    }
}

/// Fills the shape of a fluid.
void lay_fluid(Body& body, double finest, int dimensions) {
  const Table& table = body.table;
  const Lattice lattice =
      table.choice("lattice", {"cubic", "hexagonal"}, "cubic") == "cubic" ? Lattice::cubic : Lattice::hexagonal;
  const double spacing = table.positive("spacing", unit::length, finest);
  if (spacing < finest * (1 - 1e-9))
    table.fail("spacing", fmt::format("a spacing of {:.4g} m is finer than the case's {:.4g} m", spacing, finest),
               "particles are checked, and walls laid, with the case's",
               "let 'spacing' at the top be that of the finest fluid");
  body.coarser = spacing / finest;
  LatticeSpec spec{spacing, dimensions, lattice, {}};
  if (table.has("anchor")) spec.anchor = read_point(table, "anchor", dimensions);
  const ShapePtr shape = read_shape(table.table("shape"), dimensions);
  check_filling(table, *shape, {.spacing = finest, .dimensions = dimensions});
  body.points = with_place(table, [&] { return fill_lattice(*shape, spec); });
  body.may_coincide = false;
  const double jitter = table.in_range("jitter", unit::one, {0, 0.5}, 0.0) * spacing;
  if (jitter > 0) {
    shake(body.points, dimensions, jitter, static_cast<std::uint64_t>(table.integer("seed", 1)));
    body.may_coincide = true;
  }
  leave_unused(table, {"seed"});
}

}  // namespace

Body read_fluid(const Table& table, int number, double spacing, int dimensions) {
  Body body{table.text("name", fmt::format("fluid{}", number)), Group::fluid, number, {}, {}, table};
  if (table.has("particles")) {
    take_particle_list(body, dimensions);
    leave_unused(table, {"shape", "lattice", "anchor", "jitter", "seed", "spacing"});
  } else {
    lay_fluid(body, spacing, dimensions);
  }
  if (body.points.empty())
    throw InputError(
        {.what = fmt::format("fluid '{}' has no particles", body.name),
         .where = table.where(),
         .why = fmt::format("no lattice point of spacing {:.4g} m lies in its shape", spacing * body.coarser),
         .fix = "make the shape larger or the spacing smaller"});
  check_room(table, static_cast<double>(body.points.size()), spacing);
  return body;
}

}  // namespace undine
