#pragma once
// What WeaklyCompressible<N> does at walls; included by weakly_compressible_impl.hpp alone.
#include "undine/engine/corrected_interpolation.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {

template <int N>
void WeaklyCompressible<N>::add_wall_stages() {
  if (options_.wall_density == WallDensity::extrapolated) {
    this->add_sweep(wall_pressure_, false);
    if (holds() || options_.walls.moves()) this->add_sweep(wall_answer_, false);
    if (options_.walls.moves()) add_inertia_stage();
    this->add_update("wall answer", Group::wall,
                     rules::AnswerExtrapolatedPressure{options_.materials, options_.wall_pulls});
    if (holds()) this->add_update("wall friction velocity", Group::wall, rules::AnswerFrictionVelocity{});
    return;
  }
  if (options_.wall_density == WallDensity::copied) {
    const FieldSet answer = Fields<rho, p, c>::set();
    plan_.add(
        {"ghosts' answer", Resources(Group::fluid, answer | Fields<x>::set()), Resources(Group::wall, answer),
         [this] { ghosts_->answer(store_, this->gravity_of_ghosts(), options_.wall_pulls, options_.materials); }});
    return;
  }
  if (options_.wall_density == WallDensity::mirrored) {
    add_mirror_stage();
  } else if (options_.wall_density == WallDensity::modified) {
    this->add_sweep(wall_summation_, false);
    this->add_update("wall density", Group::wall, rules::AnswerModifiedDensity{});
  } else {
    this->add_sweep(wall_continuity_, false);
  }
  this->add_update("wall equation of state", Group::wall, rules::ApplyEquationOfState{options_.materials});
}

/// In the frame of an accelerated wall gravity is g - a_w: Adami et al. (2012), eq. 27.
template <int N>
void WeaklyCompressible<N>::add_inertia_stage() {
  const Resources changed(Group::wall, Fields<p_sum>::set());
  plan_.add({"wall inertia", Resources(changed).add(Group::wall, Fields<dx_sum>::set()), changed, [this] {
               const auto& walls = options_.walls;
               std::vector<Vec<N>> acceleration;
               for (const auto& motion : walls.motions) acceleration.push_back(motion.state(time_).acceleration);
               auto pressure = store_.template get<p_sum>();
               const auto moment = store_.template get<dx_sum>();
               for_each_particle(store_, Group::wall, [&](std::size_t i) {
                 const auto motion = walls.motion[static_cast<std::size_t>(store_.ids()[i] - walls.first_id)];
                 if (motion >= 0) pressure[i] -= dot(acceleration[static_cast<std::size_t>(motion)], moment[i]);
               });
             }});
}

/// rho_w = rho_g + (x_w - x_g).grad rho_g from the fluid at the mirror image x_g; rho_0 where no fluid is near. English
/// et al. (2022), eq. 10-15. A wall to which fluid sticks has v_w = 2 v_wall - v_g.
template <int N>
void WeaklyCompressible<N>::add_mirror_stage() {
  Resources reads(Group::fluid, Fields<m, rho, v>::set() | this->place());
  reads.add(Group::wall, Fields<x, v, rho_0>::set());
  Resources writes(Group::wall, Fields<rho>::set());
  if (holds()) writes.add(Group::wall, Fields<v_friction>::set());
  plan_.add({"wall mirror", reads, writes, [this] {
               const InterpolationSource<N> source = this->interpolation_source();
               const auto& walls = options_.walls;
               const auto at = store_.template get<x>();
               const auto own = store_.template get<v>();
               const auto rest = store_.template get<rho_0>();
               auto density = store_.template get<rho>();
               auto friction = store_.template get<v_friction>();
               for_each_particle(store_, Group::wall, [&](std::size_t i) {
                 const Vec<N>& to_mirror = walls.to_mirror[static_cast<std::size_t>(store_.ids()[i] - walls.first_id)];
                 const CorrectedFluid<N> fluid = interpolate_corrected(source, at[i] + to_mirror);
                 density[i] = fluid.weight > 0 ? fluid.rho - dot(to_mirror, fluid.grad_rho) : rest[i];
                 if (!options_.wall_pulls) density[i] = std::max(density[i], rest[i]);
                 if (!friction.empty()) friction[i] = fluid.weight > 0 ? 2.0 * own[i] - fluid.v : own[i];
               });
             }});
}

/// Forces of walls that are not the answer to pressure.
template <int N>
void WeaklyCompressible<N>::add_push_stages() {
  if (holds()) this->add_update("fluid friction velocity", Group::fluid, rules::TakeOwnVelocity{});
  this->add_sweep(push_, true);
}

template <int N>
void WeaklyCompressible<N>::evaluate_wall_forces() {
  const bool answers = options_.wall_density != WallDensity::none;
  if (answers) this->run(wall_force_);
  if (!options_.repulsion && !holds()) return;
  this->run(pushed_back_);
  auto a = store_.template get<acc>();
  const auto push = store_.template get<acc_wall>();
  for_each_particle(store_, Group::wall, [&](std::size_t i) { a[i] = answers ? a[i] + push[i] : push[i]; });
}

}  // namespace undine
