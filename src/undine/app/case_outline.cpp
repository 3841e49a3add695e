#include "undine/app/case_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "undine/app/case_setup.hpp"
#include "undine/app/gauges.hpp"
#include "undine/app/gauges/context.hpp"
#include "undine/app/run/output.hpp"
#include "undine/app/watchdog/limits.hpp"

namespace undine {
namespace {

template <int N>
CaseOutline outline(const Document& document, const RunOptions& options) {
  const Table root = document.root();
  const CaseSetup<N> setup = read_case<N>(root);
  const OutputPlan output = read_output(root, options, setup.choice.end);
  read_watch_limits(root);  // no more than looked at: it changes no result
  const GaugeSet<N> gauges(root, gauge_context(setup, output));
  document.finish();

  CaseOutline result{.hash = {},
                     .dimensions = N,
                     .spacing = setup.spacing,
                     .support = setup.options().support.uniform,
                     .end = setup.choice.end,
                     .fluid = static_cast<double>(setup.store.range(Group::fluid).size()),
                     .wall = static_cast<double>(setup.store.range(Group::wall).size()),
                     .series = gauges.files(),
                     .warnings = setup.warnings};
  result.series.emplace_back("energies", energy_columns());
  double sound_speed = 0;
  for (const auto& material : setup.options().materials)
    sound_speed = std::max(sound_speed, material.sound_speed(material.rho_0));
  const StepLimits& limits = setup.choice.limits;
  const double h = setup.options().support.uniform / setup.options().support.kappa;
  result.step = limits.fixed > 0 ? limits.fixed
                                 : std::min(limits.largest, limits.courant * h / (sound_speed + setup.expected_speed));
  const auto* liquid = std::get_if<WeaklyCompressibleOptions<N>>(&setup.scheme);
  if (limits.fixed == 0 && liquid && liquid->viscosity)
    for (const auto& material : liquid->materials)
      result.step = std::min(result.step, viscous_step(limits, h, material));
  result.hash = document.hash();
  return result;
}

}  // namespace

double CaseOutline::pairs() const {
  const double R = support / spacing;  // neighbours on a lattice
  const double neighbours = dimensions == 3   ? 4 * std::numbers::pi / 3 * R * R * R
                            : dimensions == 2 ? std::numbers::pi * R * R
                                              : 2 * R;
  return fluid * neighbours * steps();
}

double CaseOutline::memory() const {
  constexpr double program = 40e6, fields = 500, list_entry = 4;  // bytes; lists hold pairs up to 1.1 H, walls' as well
  return program + particles() * (fields + list_entry * std::pow(1.1, dimensions) * pairs() / (fluid * steps()));
}

CaseOutline outline_case(const RunOptions& options) {
  Document document = Document::load(options.file);
  for (const auto& assignment : options.sets) document.set(assignment);
  const Table root = document.root();
  switch (root.integer("dimensions", 3)) {
    case 1:
      return outline<1>(document, options);
    case 2:
      return outline<2>(document, options);
    case 3:
      return outline<3>(document, options);
    default:
      root.fail("dimensions", "dimensions must be 1, 2 or 3", {}, "choose one of them");
  }
}

}  // namespace undine
