#include "undine/schemes/force_parts.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "undine/schemes/gas.hpp"
#include "undine/schemes/neighbourhood.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {
namespace {

using namespace field;

// What the uses of the sweeps are called, in their order.
constexpr std::array<std::string_view, 7> in_gas_force{
    "pressure", "work", "continuity", "artificial viscosity", "conductivity", "viscosity", "signal speed"};
constexpr std::array<std::string_view, 8> in_consistent_force{
    "approach speed", "pressure",          "continuity", "artificial viscosity",
    "diffusion",      "shifted transport", "viscosity",  "wall friction"};
constexpr std::array<std::string_view, 2> in_push{"repulsion", "no-slip friction"};

/// The neighbourhood of one particle, on which terms run alone.
template <int N>
class Apart {
 public:
  Apart(const Flow<N>& flow, std::size_t particle)
      : flow_(flow), near_(flow.store(), flow.neighbours(), flow.domain(), particle) {}

  /// What use k of a sweep adds to Target, from each group that both it and the sweep take from.
  template <std::size_t k, class Target, class Sweep>
  void take(Sweep sweep, std::string_view term, const std::array<bool, group_count>& groups) {
    std::apply([](auto&... use) { ((use.active = false), ...); }, sweep.uses());
    sweep.template use<k>().active = true;
    if (!sweep.adds()[static_cast<std::size_t>(Target::id)]) return;
    for (const Group source : all_groups) {
      if (!groups[static_cast<std::size_t>(source)]) continue;
      sweep.take_from({source == Group::fluid, source == Group::wall});
      sweep.run(flow_.context(near_.store, near_.lists), {BackendKind::serial, PairPrecision::double_precision});
      parts_.push_back({fmt::format("{} ({})", term, source == Group::fluid ? "fluid" : "wall"),
                        near_.store.template get<Target>()[near_.centre]});
    }
  }

  /// The same of all uses that act, as the flow has set them. `names`: of the uses, in their order.
  template <class Target, std::size_t count, class... Uses>
  void take_all(const PairSweep<N, Uses...>& sweep, const std::array<std::string_view, count>& names) {
    static_assert(count == sizeof...(Uses));
    [&]<std::size_t... k>(std::index_sequence<k...>) {
      const auto one = [&]<std::size_t which>(std::integral_constant<std::size_t, which>) {
        const auto& use = std::get<which>(sweep.uses());
        if (use.active) take<which, Target>(sweep, names[which], use.sources);
      };
      (one(std::integral_constant<std::size_t, k>{}), ...);
    }
    (std::index_sequence_for<Uses...>{});
  }

  std::vector<ForcePart<N>> finish() {
    const auto& options = flow_.options();
    const Vec<N> place = near_.store.template get<x>()[near_.centre];
    if (norm_sq(options.gravity) > 0) parts_.push_back({"gravity", options.gravity});
    if (options.body_force) parts_.push_back({"body force", options.body_force(place, flow_.time())});
    return std::move(parts_);
  }

 private:
  const Flow<N>& flow_;
  Neighbourhood<N> near_;
  std::vector<ForcePart<N>> parts_;
};

template <int N>
void take_apart(Apart<N>& apart, const Gas<N>& flow) {
  apart.template take_all<acc>(flow.force_sweep(), in_gas_force);
  if (flow.options().repulsion) apart.template take_all<acc_wall>(flow.push_sweep(), in_push);
}

/// Terms that act in every run of a liquid cannot be told to rest: they run in the sweep of forces on walls, where each
/// can.
template <int N>
void take_apart(Apart<N>& apart, const WeaklyCompressible<N>& flow) {
  const auto& options = flow.options();
  const bool walls = options.wall_density != walls::WallDensity::none;
  const bool holds = options.wall_no_slip && options.viscosity;
  if (options.consistent()) {
    apart.template take_all<acc>(flow.consistent_force_sweep(), in_consistent_force);
    apart.template take_all<acc_wall>(flow.consistent_force_sweep(), in_consistent_force);
    return;
  }
  typename WeaklyCompressibleSweeps<N>::WallForce force{"force part", Group::fluid};
  force.template use<0>().term = options.pressure;
  if (options.viscosity) force.template use<1>().term = *options.viscosity;
  if (options.artificial) force.template use<2>().term = *options.artificial;
  for (const Group source : all_groups) {
    const bool wall = source == Group::wall;
    if (wall && !walls) continue;
    const bool drags = !wall || options.wall_friction;
    const std::array<bool, group_count> from{!wall, wall};
    apart.template take<0, acc>(force, "pressure", from);
    if (options.viscosity && drags && !(wall && holds)) apart.template take<1, acc>(force, "viscosity", from);
    if (options.artificial && drags) apart.template take<2, acc>(force, "artificial viscosity", from);
  }
  if (options.repulsion || holds) apart.template take_all<acc_wall>(flow.push_sweep(), in_push);
}

}  // namespace

template <int N>
std::vector<ForcePart<N>> force_parts(const Flow<N>& flow, std::size_t particle) {
  if (!std::isfinite(norm_sq(flow.store().template get<x>()[particle]))) return {};
  Apart<N> apart(flow, particle);
  if (const auto* gas = dynamic_cast<const Gas<N>*>(&flow)) take_apart(apart, *gas);
  if (const auto* liquid = dynamic_cast<const WeaklyCompressible<N>*>(&flow)) take_apart(apart, *liquid);
  return apart.finish();
}

template std::vector<ForcePart<1>> force_parts(const Flow<1>&, std::size_t);
template std::vector<ForcePart<2>> force_parts(const Flow<2>&, std::size_t);
template std::vector<ForcePart<3>> force_parts(const Flow<3>&, std::size_t);

}  // namespace undine
