#include "undine/app/setup/wall_points.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "undine/app/setup/filling.hpp"
#include "undine/geometry/fill.hpp"

namespace undine {
namespace {

constexpr std::int64_t most_layers = 100;

/// How many layers a wall has: as asked, but neither thicker than any support nor, unless meant, thinner than this one.
int read_layers(const Table& table, double support, double spacing, int usual) {
  const int needed = static_cast<int>(std::ceil(support / spacing - 1e-9));
  const std::int64_t asked = table.integer("layers", usual > 0 ? usual : needed);
  if (asked > most_layers)
    table.fail("layers", fmt::format("a wall of {} layers is thicker than any support", asked),
               fmt::format("{} layers span it", needed), fmt::format("set layers = {}, or leave it out", needed));
  const int layers = static_cast<int>(std::max<std::int64_t>(asked, 0));
  if (layers < 1 || (layers < needed && !table.flag("thin", usual > 0)))
    table.fail(
        "layers", fmt::format("a wall of {} layer{} is thinner than the support", layers, layers == 1 ? "" : "s"),
        fmt::format(
            "the support radius {:.4g} m spans {} spacings of {:.4g} m; fluid would feel what is behind the wall",
            support, needed, spacing),
        fmt::format("set layers = {}, leave it out, or say thin = true if this is meant", needed));
  return layers;
}

}  // namespace

template <int N>
std::vector<Vec3> wall_points(const Table& table, const WallShape& wall, const Table& treatment,
                              const CaseSetup<N>& setup) {
  const auto& choice = setup.choice;
  const bool repels = choice.wall_force == walls::WallForce::repulsion;
  if (table.flag("sheet", choice.wall_layers == 1 && !repels)) {
    const auto box = wall.shape->as_box();
    if (!box)
      table.fail("sheet", "a sheet of wall particles needs a box", "points are laid on the box's faces",
                 "set sheet = false or use a box");
    return fill_face_sheet(*box, {setup.spacing, N, wall.open});
  }
  const int layers = read_layers(table, setup.options().support.uniform, setup.spacing, choice.wall_layers);
  const Side side = wall.fluid == Side::inside ? Side::outside : Side::inside;
  check_filling(table, *wall.shape, {setup.spacing, N, layers, side});
  const double spacing = repels ? repelling_spacing(treatment, setup.spacing) : setup.spacing;
  const double offset = repels && !repelling_shift(treatment) ? 0 : 0.5;
  return with_place(table, [&] { return fill_shell(*wall.shape, {spacing, layers, side, N, offset, wall.open}); });
}

double repelling_spacing(const Table& treatment, double spacing) {
  const double own = treatment.positive("spacing", unit::length, spacing);
  if (own < 0.5 * (1 - 1e-9) * spacing || own > spacing * (1 + 1e-9))
    treatment.fail("spacing", fmt::format("particles that repel cannot lie {:.4g} m apart", own),
                   fmt::format("the case's spacing is {:.4g} m", spacing), "take half of that to all of it");
  return own;
}

bool repelling_shift(const Table& treatment) { return treatment.flag("shift", true); }

template std::vector<Vec3> wall_points(const Table&, const WallShape&, const Table&, const CaseSetup<1>&);
template std::vector<Vec3> wall_points(const Table&, const WallShape&, const Table&, const CaseSetup<2>&);
template std::vector<Vec3> wall_points(const Table&, const WallShape&, const Table&, const CaseSetup<3>&);

}  // namespace undine
