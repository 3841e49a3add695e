#pragma once
// What WeaklyCompressible<N> does where gradients are corrected or particles shifted; included by
// weakly_compressible_impl.hpp alone.
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {

template <int N>
void WeaklyCompressible<N>::configure_consistent() {
  const bool walls = options_.wall_density != WallDensity::none;
  const auto continuity = continuity_.template use<0>().term;
  const auto chosen = []<class Term>(const std::optional<Term>& term) { return term.value_or(Term{}); };
  const auto viscosity = chosen(options_.viscosity);
  OneOf<terms::NoSlipForms> friction;
  friction.choose(viscosity.index());
  const std::array<bool, group_count> all{true, walls}, own{true, false};

  auto& force = consistent_force_;
  force.template use<Consistent::approach>() = {{}, true, all, {}};
  force.template use<Consistent::pressure>() = {{options_.pressure}, true, all, {}};
  force.template use<Consistent::continuity>() = {{continuity}, true, all, {}};
  force.template use<Consistent::artificial>() = {
      chosen(options_.artificial), options_.artificial.has_value(), {true, walls && options_.wall_friction}, {}};
  force.template use<Consistent::diffusion>() = {force_.template use<Sweeps::diffusion>().term, diffuses(), own, {}};
  force.template use<Consistent::transport>() = {{}, options_.shifting.has_value(), all, {}};
  force.template use<Consistent::viscosity>() = {{viscosity}, options_.viscosity.has_value(), own, {}};
  force.template use<Consistent::friction>() = {{friction}, rubs(), {false, true}, {}};
  consistent_continuity_.template use<0>() = {{continuity}, true, all, {}};
  shift_.template use<0>() = {chosen(options_.shifting), options_.shifting.has_value(), all, {}};
  gradient_.template use<0>() = {{}, true, all, {}};  // a wall is part of the neighbourhood whose moments they are
}

/// Moments and their inverse come first, then where particles drift to, then the rates, which need both.
template <int N>
void WeaklyCompressible<N>::add_consistent_stages() {
  const bool walls = options_.wall_density != WallDensity::none;
  this->add_sweep(gradient_, walls);
  this->add_update("corrected gradients", Group::fluid, rules::CorrectGradients<N>{options_.corrected_gradients});
  if (options_.shifting) this->add_sweep(shift_, walls);
  this->add_update("fluid friction velocity", Group::fluid, rules::TakeOwnVelocity{});
  if (walls && !holds()) this->add_update("wall friction velocity", Group::wall, rules::TakeOwnVelocity{});
  this->add_sweep(consistent_force_, walls);
}

}  // namespace undine
