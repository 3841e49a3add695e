#include "undine/app/setup/domain.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace undine {
namespace {

const std::vector<std::string> axes{"x", "y", "z"};

/// Refuses what cannot be along one axis.
template <int N>
void check_axis(const Table& root, int k, const CaseSetup<N>& setup) {
  const Table table = root.table("domain");
  const auto& domain = setup.domain;
  const std::string& axis = axes[static_cast<std::size_t>(k)];
  if (!(domain.high[k] > domain.low[k]))
    table.fail("high", fmt::format("the domain is empty along {}", axis), {}, "make high larger than low");
  if (!domain.periodic[k]) return;
  if (setup.options().gravity[k] != 0)
    root.fail("gravity", fmt::format("gravity acts along {}, where space repeats", axis),
              "a height has no end there, so that the energy audit could not close", "use body_force instead");
  const double reach = setup.options().support.uniform * (1 + setup.options().neighbours.skin);
  if (domain.length(k) < 2 * reach)
    table.fail("high", fmt::format("the period along {} is {:.4g} m", axis, domain.length(k)),
               fmt::format("a particle would see its own image: twice the support with skin is {:.4g} m", 2 * reach),
               "widen the domain or lessen the support");
}

}  // namespace

template <int N>
void place_domain(const Table& root, const std::vector<Body>& bodies, CaseSetup<N>& setup) {
  Bounds all;
  for (const Body& body : bodies)
    for (const auto& p : body.points) all.include(p);
  if (!setup.container.empty()) all.include(setup.container);
  const Table table = root.table("domain");
  double extent = setup.options().support.uniform;  // some room even around a single point
  for (int k = 0; k < N; ++k)
    if (std::isfinite(all.hi[k] - all.lo[k])) extent = std::max(extent, all.hi[k] - all.lo[k]);
  std::vector<double> low, high;
  for (int k = 0; k < N; ++k) {
    low.push_back(std::max(all.lo[k], -1e30) - extent);
    high.push_back(std::min(all.hi[k], 1e30) + 2 * extent);
  }
  const auto periodic = table.choices("periodic", {axes.begin(), axes.begin() + N}, {});
  if (!periodic.empty()) {
    low = table.quantities("low", unit::length, N);
    high = table.quantities("high", unit::length, N);
  } else {
    low = table.quantities("low", unit::length, N, low);
    high = table.quantities("high", unit::length, N, high);
  }
  auto& domain = setup.domain;
  for (int k = 0; k < N; ++k) {
    domain.low[k] = low[k];
    domain.high[k] = high[k];
    domain.periodic[k] = std::ranges::count(periodic, axes[k]) > 0;
    check_axis(root, k, setup);
  }
}

template <int N>
bool read_escape(const Table& root, FlowOptions<N>& options) {
  const std::string on_escape = root.table("domain").choice("on_escape", {"stop", "remove", "reflect"}, "stop");
  options.lets_escape = on_escape == "remove";
  return on_escape == "reflect";
}

template void place_domain(const Table&, const std::vector<Body>&, CaseSetup<1>&);
template void place_domain(const Table&, const std::vector<Body>&, CaseSetup<2>&);
template void place_domain(const Table&, const std::vector<Body>&, CaseSetup<3>&);

template bool read_escape(const Table&, FlowOptions<1>&);
template bool read_escape(const Table&, FlowOptions<2>&);
template bool read_escape(const Table&, FlowOptions<3>&);

}  // namespace undine
