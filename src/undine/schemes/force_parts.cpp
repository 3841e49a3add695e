#include "undine/schemes/force_parts.hpp"

#include <cmath>

#include <fmt/format.h>

#include "undine/schemes/neighbourhood.hpp"

namespace undine {

using namespace field;

template <int N>
std::vector<ForcePart<N>> force_parts(const WeaklyCompressible<N>& flow, std::size_t particle) {
  using Sweeps = WeaklyCompressibleSweeps<N>;
  const WeaklyCompressibleOptions<N>& options = flow.options();
  const Vec<N> place = flow.store().template get<x>()[particle];
  if (!std::isfinite(norm_sq(place))) return {};
  Neighbourhood<N> near(flow.store(), flow.neighbours(), flow.domain(), particle);
  Support support = options.support;
  support.per_particle = options.supports_vary();
  const SweepContext<N> run{near.store, near.lists,      flow.domain(),
                            support,    options.kernels, options.materials.front().rho_0};
  const Backend serial{BackendKind::serial, PairPrecision::double_precision};
  std::vector<ForcePart<N>> parts;
  // One use of a sweep from one group.
  const auto alone = [&]<std::size_t k, class Target>(auto& sweep, std::string_view term, Group source) {
    auto& use = sweep.template use<k>();
    use.active = true;
    use.sources = {true, true};
    sweep.take_from({source == Group::fluid, source == Group::wall});
    sweep.run(run, serial);
    use.active = false;
    parts.push_back({fmt::format("{} ({})", term, source == Group::fluid ? "fluid" : "wall"),
                     near.store.template get<Target>()[near.centre]});
  };

  const bool walls = options.wall_density != walls::WallDensity::none;
  const bool holds = options.wall_no_slip && options.viscosity;
  typename Sweeps::WallForce force{"force part", Group::fluid};
  force.template use<0>() = {options.pressure, false, {}, {}};
  force.template use<1>() = {options.viscosity.value_or(OneOf<terms::ViscosityForms>{}), false, {}, {}};
  force.template use<2>() = {options.artificial.value_or(OneOf<terms::ArtificialViscosities>{}), false, {}, {}};
  for (const Group source : all_groups) {
    const bool wall = source == Group::wall;
    if (wall && !walls) continue;
    const bool drags = !wall || options.wall_friction;
    alone.template operator()<0, acc>(force, "pressure", source);
    if (options.viscosity && drags && !(wall && holds)) alone.template operator()<1, acc>(force, "viscosity", source);
    if (options.artificial && drags) alone.template operator()<2, acc>(force, "artificial viscosity", source);
  }
  typename Sweeps::WallPush push{"push part", Group::fluid};
  push.template use<0>() = {options.repulsion.value_or(terms::Repulsion{}), false, {}, {}};
  OneOf<terms::NoSlipForms> no_slip;
  if (holds) no_slip.choose(options.viscosity->index());
  push.template use<1>() = {no_slip, false, {}, {}};
  if (options.repulsion) alone.template operator()<0, acc_wall>(push, "repulsion", Group::wall);
  if (holds) alone.template operator()<1, acc_wall>(push, "no-slip friction", Group::wall);

  if (norm_sq(options.gravity) > 0) parts.push_back({"gravity", options.gravity});
  if (options.body_force) parts.push_back({"body force", options.body_force(place, flow.time())});
  return parts;
}

template std::vector<ForcePart<1>> force_parts(const WeaklyCompressible<1>&, std::size_t);
template std::vector<ForcePart<2>> force_parts(const WeaklyCompressible<2>&, std::size_t);
template std::vector<ForcePart<3>> force_parts(const WeaklyCompressible<3>&, std::size_t);

}  // namespace undine
