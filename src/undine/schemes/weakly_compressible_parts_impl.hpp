#pragma once
// What acts on one particle of WeaklyCompressible<N>, term by term; included by weakly_compressible_impl.hpp alone.
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {

template <int N>
std::vector<ForcePart<N>> WeaklyCompressible<N>::force_parts(std::size_t particle) const {
  const Vec<N> place = store_.template get<x>()[particle];
  if (!std::isfinite(norm_sq(place))) return {};
  Neighbourhood<N> near(store_, neighbours_, domain_, particle);
  Support support = options_.support;
  support.per_particle = options_.supports_vary();
  const SweepContext<N> run{near.store, near.lists, domain_, support, options_.kernels,
                            options_.materials.front().rho_0};
  const Backend serial{BackendKind::serial, PairPrecision::double_precision};
  const bool walls = options_.wall_density != WallDensity::none;
  const bool friction = walls && options_.wall_friction && !holds();
  std::vector<ForcePart<N>> parts;

  // One use of a sweep at a time, from one group.
  const auto alone = [&]<std::size_t k, class Target>(auto& sweep, std::string_view term, Group source) {
    sweep.template use<k>().active = true;
    sweep.take_from({source == Group::fluid, source == Group::wall});
    sweep.template use<k>().sources = {true, true};
    sweep.run(run, serial);
    sweep.template use<k>().active = false;
    parts.push_back({fmt::format("{} ({})", term, source == Group::fluid ? "fluid" : "wall"),
                     near.store.template get<Target>()[near.centre]});
  };
  typename Sweeps::WallForce force{"force part", Group::fluid};
  force.template use<0>() = {options_.pressure, false, {}, {}};
  force.template use<1>() = {options_.viscosity.value_or(OneOf<terms::ViscosityForms>{}), false, {}, {}};
  force.template use<2>() = {options_.artificial.value_or(OneOf<terms::ArtificialViscosities>{}), false, {}, {}};
  for (const Group source : all_groups) {
    const bool wall = source == Group::wall;
    if (wall && !walls) continue;
    alone.template operator()<0, acc>(force, "pressure", source);
    if (options_.viscosity && (!wall || friction)) alone.template operator()<1, acc>(force, "viscosity", source);
    if (options_.artificial && (!wall || (walls && options_.wall_friction)))
      alone.template operator()<2, acc>(force, "artificial viscosity", source);
  }
  if (pushes()) {
    typename Sweeps::WallPush push{"push part", Group::fluid};
    push.template use<0>() = {options_.repulsion.value_or(terms::Repulsion{}), false, {}, {}};
    OneOf<terms::NoSlipForms> no_slip;
    if (holds()) no_slip.choose(options_.viscosity->index());
    push.template use<1>() = {no_slip, false, {}, {}};
    if (options_.repulsion) alone.template operator()<0, acc_wall>(push, "repulsion", Group::wall);
    if (holds()) alone.template operator()<1, acc_wall>(push, "no-slip friction", Group::wall);
  }
  if (norm_sq(options_.gravity) > 0) parts.push_back({"gravity", options_.gravity});
  if (options_.body_force) parts.push_back({"body force", options_.body_force(place, time_)});
  return parts;
}

}  // namespace undine
