#pragma once
// The definitions of WeaklyCompressible<N>, compiled once for each N in weakly_compressible_Nd.cpp.
#include <fmt/format.h>

#include "undine/schemes/particle_rules.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {
namespace {

using namespace field;
using walls::WallDensity;

}  // namespace

template <int N>
WeaklyCompressible<N>::WeaklyCompressible(Store<N> store, const Domain<N>& domain, Options options,
                                          const std::vector<double>& memory)
    : WeaklyCompressible(std::move(store), domain, std::move(options), unstarted) {
  this->start(memory);
}

template <int N>
WeaklyCompressible<N>::WeaklyCompressible(Store<N> store, const Domain<N>& domain, Options options, Unstarted)
    : WeaklyCompressible(std::move(store), domain, std::make_shared<const Options>(std::move(options))) {}

template <int N>
WeaklyCompressible<N>::WeaklyCompressible(Store<N> store, const Domain<N>& domain,
                                          std::shared_ptr<const Options> options)
    : Flow<N>(std::move(store), domain, options), options_(*options) {
  configure();
  make_plan();
}

/// Tells each sweep which of its terms are in use, and between which groups.
template <int N>
void WeaklyCompressible<N>::configure() {
  const bool walls = options_.wall_density != WallDensity::none;
  const bool friction = walls && options_.wall_friction;
  // Ghosts are fluid. Diffusion must not see their density where it is not the hydrostatic one of their place, nor
  // gradients that nothing mirrors.
  const bool ghosts = ghosts_.has_value();
  const bool at_rest = options_.ghost_hydrostatic || norm_sq(options_.gravity) == 0;
  const bool ghosts_diffuse = ghosts && at_rest && !renormalises();

  const auto continuity = rate_form(options_.density, options_.continuity);

  const auto chosen = []<class Term>(const std::optional<Term>& term) { return term.value_or(Term{}); };
  force_.template use<Sweeps::pressure>().term = options_.pressure;
  force_.template use<Sweeps::continuity>().term = continuity;
  force_.template use<Sweeps::artificial>() = {
      chosen(options_.artificial), options_.artificial.has_value(), {true, friction}, {}};
  force_.template use<Sweeps::diffusion>() = {chosen(options_.diffusion), diffuses(), {true, ghosts_diffuse}, {}};
  force_.template use<Sweeps::xsph>() = {chosen(options_.xsph), options_.xsph.has_value(), {true, ghosts}, {}};
  force_.template use<Sweeps::viscosity>() = {
      chosen(options_.viscosity), options_.viscosity.has_value(), {true, friction && !holds()}, {}};
  force_.take_from({true, walls});  // wall particles that only repel are none of its neighbours
  continuity_.template use<0>() = {continuity, true, {true, walls}, {}};
  wall_continuity_.template use<0>() = {continuity, true, {true, false}, {}};
  wall_summation_.template use<0>() = {{}, true, {true, false}, {}};
  wall_pressure_.template use<0>() = {{}, true, {true, false}, {}};
  gradient_.template use<0>() = {{}, true, {true, false}, {}};
  strain_.template use<0>() = {{}, true, {true, friction}, {}};
  auto& fourtakas = force_.template use<Sweeps::diffusion>().term.template get<terms::DiffusionFourtakas>();
  auto& extrapolation = wall_pressure_.template use<0>().term;
  for (int k = 0; k < N; ++k) extrapolation.gravity[k] = fourtakas.gravity[k] = options_.gravity[k];

  terms::Repulsion repulsion = options_.repulsion.value_or(terms::Repulsion{});
  OneOf<terms::NoSlipForms> no_slip;
  if (holds()) no_slip.choose(options_.viscosity->index());
  wall_answer_.template use<0>() = {{}, holds(), {true, false}, {}};
  wall_answer_.template use<1>() = {{}, options_.walls.moves(), {true, false}, {}};
  push_.template use<0>() = {repulsion, options_.repulsion.has_value(), {false, true}, {}};
  push_.template use<1>() = {no_slip, holds(), {false, true}, {}};
  pushed_back_.template use<0>() = {repulsion, options_.repulsion.has_value(), {true, false}, {}};
  pushed_back_.template use<1>() = {no_slip, holds(), {true, false}, {}};

  // Differences of pressure say nothing of what presses on a wall.
  const OneOf<terms::PressureForms> on_walls =
      options_.consistent() ? OneOf<terms::PressureForms>(terms::PressureSum{}) : options_.pressure;
  wall_force_.template use<0>() = {on_walls, true, {true, false}, {}};
  wall_force_.template use<1>() = {
      chosen(options_.viscosity), options_.viscosity && friction && !holds(), {true, false}, {}};
  wall_force_.template use<2>() = {chosen(options_.artificial), options_.artificial && friction, {true, false}, {}};
  if (options_.consistent()) configure_consistent();
}

/// What one evaluation of the rates consists of. The order follows from what the stages read and write.
template <int N>
void WeaklyCompressible<N>::make_plan() {
  const bool walls = options_.wall_density != WallDensity::none;

  this->add_summation_stages(options_.density, walls);
  this->add_update("equation of state", Group::fluid, rules::ApplyEquationOfState{options_.materials});
  if (walls) add_wall_stages();
  if (options_.consistent()) {
    add_consistent_stages();
  } else {
    if (renormalises()) {
      this->add_sweep(gradient_, false);
      this->add_update("renormalised gradient", Group::fluid, rules::RenormaliseGradient<N>{});
    }
    this->add_sweep(force_, walls);
  }
  if (pushes()) add_push_stages();
  if (options_.strain_dissipation) add_strain_stage();
  this->add_body_force_stage(pushes() || rubs());

  FieldSet given_fields = Fields<x, v, m, rho, x_list>::set();
  const auto give = [&](bool needed, const FieldSet& fields) {
    if (needed) given_fields |= fields;
  };
  give(walls || options_.repulsion || options_.supports_vary(), Fields<rho_0>::set());
  give(options_.wall_density == WallDensity::modified, Fields<rho_wall>::set());
  give(options_.viscosity || options_.strain_dissipation, Fields<mu>::set());
  give(options_.supports_vary(), Fields<h>::set());
  // Terms that are not in use leave these at zero, and so do walls.
  const Resources at_rest = Resources(Group::fluid, Fields<grad_rho_l>::set())
                                .add(Group::wall, Fields<grad_rho_l, p, c, moment, v_xsph>::set());
  this->finish_plan({given_fields, Fields<p, c, acc, drho, mu_cfl>::set(),
                     Fields<acc_old, x_start, v_start, rho_start>::set(), at_rest});
}

/// Dissipation by the velocity gradient L: 2 mu D:D per volume, D = (L + L^T)/2. Saalfeld (2012), eq. 51-54 (with the
/// factor 2).
template <int N>
void WeaklyCompressible<N>::add_strain_stage() {
  this->add_sweep(strain_, options_.wall_density != WallDensity::none);
  plan_.add({"dissipation", Resources(Group::fluid, Fields<strain, m, rho, mu>::set()), {}, [this] {
               const auto gradient = store_.template get<strain>();
               const auto mass = store_.template get<m>();
               const auto density = store_.template get<rho>();
               const auto viscosity = store_.template get<mu>();
               strain_power_ = total_over(store_, Group::fluid, [&](std::size_t a) {
                 double d_d = 0;
                 for (int i = 0; i < N; ++i)
                   for (int j = 0; j < N; ++j) d_d += sq(0.5 * (gradient[a][i][j] + gradient[a][j][i]));
                 return 2 * viscosity[a] * d_d * mass[a] / density[a];
               });
             }});
}

/// H follows the density of before.
template <int N>
void WeaklyCompressible<N>::prepare() {
  if (options_.supports_vary()) update(store_, Group::fluid, rules::FollowDensity<N>{options_.support.uniform});
}

template <int N>
std::span<const Vec<N>> WeaklyCompressible<N>::drift_correction() const {
  const bool xsph = options_.xsph && options_.xsph_target == XsphTarget::position;
  if (!xsph && !options_.shifting) return {};
  return store_.template get<v_xsph>();
}

template <int N>
void WeaklyCompressible<N>::compress(double dt) {
  auto density = store_.template get<rho>();
  const auto rate = store_.template get<drho>();
  const auto diffused = store_.template get<drho_diff>();
  if (options_.density == DensityForm::evolved) {
    std::vector<double> smallest;
    for (const auto& substance : options_.materials) smallest.push_back(substance.smallest_density());
    const auto material = store_.materials();
    for_each_particle(store_, Group::fluid, [&, diffuses = diffuses() || options_.shifting](std::size_t i) {
      density[i] += dt * (diffuses ? rate[i] + diffused[i] : rate[i]);
      density[i] = std::max(density[i], smallest[material[i]]);
    });
  }
  if (options_.wall_density == WallDensity::evolved)
    for_each_particle(store_, Group::wall, [&](std::size_t i) {
      density[i] += dt * rate[i];
      if (!options_.wall_pulls) density[i] = std::max(density[i], store_.template get<rho_0>()[i]);
    });
}

template <int N>
std::vector<typename Flow<N>::Evolved> WeaklyCompressible<N>::evolved() const {
  auto all = Flow<N>::evolved();
  std::vector<int> rates{drho::id};
  if (diffuses() || options_.shifting) rates.push_back(drho_diff::id);
  if (options_.density == DensityForm::evolved) all.push_back({Group::fluid, rho::id, rates});
  if (options_.wall_density == WallDensity::evolved) all.push_back({Group::wall, rho::id, {drho::id}});
  return all;
}

template <int N>
void WeaklyCompressible<N>::limit_state() {
  if (options_.wall_density != WallDensity::evolved || options_.wall_pulls) return;
  auto density = store_.template get<rho>();
  const auto rest = store_.template get<rho_0>();
  for_each_particle(store_, Group::wall, [&](std::size_t i) { density[i] = std::max(density[i], rest[i]); });
}

template <int N>
void WeaklyCompressible<N>::continuity() {
  if (options_.density == DensityForm::evolved || options_.wall_density == WallDensity::evolved) this->refresh_lists();
  if (options_.density == DensityForm::evolved && options_.consistent()) this->run(consistent_continuity_);
  if (options_.density == DensityForm::evolved && !options_.consistent()) this->run(continuity_);
  if (options_.wall_density == WallDensity::evolved) this->run(wall_continuity_);
}

/// Pushes of surfaces, and XSPH on the velocity itself. What it takes from the kinetic energy is booked exactly.
template <int N>
void WeaklyCompressible<N>::smooth() {
  Flow<N>::smooth();
  if (!options_.xsph || options_.xsph_target != XsphTarget::velocity) return;
  auto u = store_.template get<v>();
  const auto correction = store_.template get<v_xsph>();
  const auto mass = store_.template get<m>();
  ledger_.xsph += total_over(store_, Group::fluid, [&](std::size_t i) {
    const Vec<N> old = u[i];
    u[i] += correction[i];
    return 0.5 * mass[i] * (norm_sq(old) - norm_sq(u[i]));
  });
}

/// What the terms of a force sweep took from the energy. Of XSPH, which changes no rate, that is nothing; what shifted
/// particles take over from their neighbours stands in its place.
template <int N>
template <class Force>
void WeaklyCompressible<N>::book_force(const Force& force, double dt) {
  constexpr int fluid = 0, wall = 1;
  const auto power = [&]<std::size_t k>(std::integral_constant<std::size_t, k>) -> const Power& {
    return std::get<k>(force.uses()).power;
  };
  const Power& pressure = power(std::integral_constant<std::size_t, Sweeps::pressure>{});
  const Power& compression = power(std::integral_constant<std::size_t, Sweeps::continuity>{});
  const Power& viscous = power(std::integral_constant<std::size_t, Sweeps::viscosity>{});
  const Power& artificial = power(std::integral_constant<std::size_t, Sweeps::artificial>{});
  const Power& diffusion = power(std::integral_constant<std::size_t, Sweeps::diffusion>{});
  const Power& moved = power(std::integral_constant<std::size_t, Sweeps::xsph>{});
  ledger_.viscous -= dt * viscous[fluid];
  ledger_.artificial -= dt * artificial[fluid];
  ledger_.diffusion -= dt * (diffusion[fluid] + diffusion[wall]);
  ledger_.exchange -= dt * (pressure[fluid] + compression[fluid]);
  ledger_.walls -= dt * (pressure[wall] + compression[wall] + viscous[wall] + artificial[wall]);
  ledger_.xsph -= dt * (moved[fluid] + moved[wall]);
}

template <int N>
void WeaklyCompressible<N>::book(double dt) {
  constexpr int wall = 1;
  if (options_.consistent()) {
    book_force(consistent_force_, dt);
    ledger_.walls -= dt * consistent_force_.template use<Consistent::friction>().power[wall];
  } else {
    book_force(force_, dt);
  }
  if (pushes()) ledger_.walls -= dt * (push_.template use<0>().power[wall] + push_.template use<1>().power[wall]);
  ledger_.body -= dt * body_power_;
  strain_dissipated_ += dt * strain_power_;
}

template <int N>
Step WeaklyCompressible<N>::stable_step(const StepLimits& limits) const {
  if (limits.fixed > 0) return {limits.fixed, "fixed"};
  const auto H = store_.template get<h>();
  const auto sound = store_.template get<c>();
  const auto approach = store_.template get<mu_cfl>();
  const auto a = store_.template get<acc>();
  const auto viscosity = store_.template get<mu>();
  const auto density = store_.template get<rho>();
  const double kappa = options_.support.kappa;
  const bool viscous = options_.viscosity.has_value();
  // All limits in one pass, which memory bounds.
  const auto fastest = largest_over(store_, Group::fluid, Vec<3>{}, [&](std::size_t i) {
    const double rate = kappa / (options_.supports_vary() ? H[i] : options_.support.uniform);
    return Vec<3>{{(sound[i] + approach[i]) * rate, norm_sq(a[i]) * sq(rate),
                   viscous ? viscosity[i] / density[i] * sq(rate) : 0.0}};
  });
  return shortest_step(limits, {fastest[0], fastest[1], fastest[2]});
}

template <int N>
Energies WeaklyCompressible<N>::energies() const {
  const auto mass = store_.template get<m>();
  const auto density = store_.template get<rho>();
  const auto material = store_.materials();
  Energies e = this->energies_of_motion();
  e.elastic = total_over(store_, Group::fluid,
                         [&](std::size_t i) { return mass[i] * options_.materials[material[i]].energy(density[i]); });
  e.strain_power = strain_power_;
  e.strain_dissipated = strain_dissipated_;
  return e;
}

template <int N>
std::vector<double*> WeaklyCompressible<N>::remembered() {
  std::vector<double*> numbers{&body_power_, &strain_power_, &strain_dissipated_};
  std::ranges::copy(this->accounts(), std::back_inserter(numbers));
  if (options_.consistent()) {
    this->remember_powers(consistent_force_, numbers);
  } else {
    this->remember_powers(force_, numbers);
  }
  if (pushes()) this->remember_powers(push_, numbers);
  return numbers;
}

}  // namespace undine

#include "undine/schemes/weakly_compressible_consistent_impl.hpp"
#include "undine/schemes/weakly_compressible_walls_impl.hpp"
