#pragma once
#include <algorithm>

#include <fmt/format.h>

#include "undine/app/case_setup.hpp"
#include "undine/app/gauges/gauge.hpp"
#include "undine/app/run/output.hpp"

namespace undine {

/// What a case tells its gauges.
template <int N>
GaugeContext<N> gauge_context(const CaseSetup<N>& setup, const OutputPlan& output) {
  GaugeContext<N> context{.spacing = setup.spacing,
                          .interval = output.energies > 0 ? output.energies : setup.choice.end / 200,
                          .gravity = setup.options().gravity,
                          .domain = setup.domain,
                          .bodies = setup.bodies,
                          .body_of_id = setup.body_of_id,
                          .support = setup.options().support.uniform,
                          .walls = setup.walls,
                          .container = setup.container};
  for (const auto& material : setup.options().materials) {
    const bool taken = std::ranges::count(context.materials, material.name) > 0;
    context.materials.push_back(taken ? fmt::format("{}{}", material.name, context.materials.size()) : material.name);
    context.rest_densities.push_back(material.rho_0);
  }
  return context;
}

}  // namespace undine
