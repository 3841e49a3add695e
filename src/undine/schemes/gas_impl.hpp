#pragma once
// The definitions of Gas<N>, compiled once for each N in gas_Nd.cpp.
#include <cmath>

#include <fmt/format.h>

#include "undine/schemes/gas.hpp"
#include "undine/schemes/gas_rules.hpp"
#include "undine/schemes/gas_supports_impl.hpp"
#include "undine/schemes/particle_rules.hpp"
#include "undine/schemes/state_error.hpp"

namespace undine {
namespace {

using namespace field;
using walls::WallDensity;

}  // namespace

template <int N>
Gas<N>::Gas(Store<N> store, const Domain<N>& domain, Options options, const std::vector<double>& memory)
    : Gas(std::move(store), domain, std::move(options), unstarted) {
  this->start(memory);
}

template <int N>
Gas<N>::Gas(Store<N> store, const Domain<N>& domain, Options options, Unstarted)
    : Gas(std::move(store), domain, std::make_shared<const Options>(std::move(options))) {}

template <int N>
Gas<N>::Gas(Store<N> store, const Domain<N>& domain, std::shared_ptr<const Options> options)
    : Flow<N>(std::move(store), domain, options), options_(*options) {
  mirrored_ = ghosts_.has_value();
  held_ = options_.wall_density == WallDensity::held;
  configure();
  make_plan();
}

/// Tells each sweep which of its terms are in use, and between which groups.
template <int N>
void Gas<N>::configure() {
  const std::array<bool, group_count> from{true, answered()}, from_fluid{true, false};
  const typename Sweeps::Continuity continuity{rate_form(options_.density, options_.continuity)};
  const auto chosen = []<class Term>(const std::optional<Term>& term) { return term.value_or(Term{}); };

  density_.template use<0>() = {options_.grad_h, true, from, {}};
  rate_.template use<0>() = {continuity, true, from, {}};
  foresight_.template use<0>() = {{}, true, {true, mirrored_}, {}};
  gradient_.template use<0>() = {{}, true, from, {}};
  const auto set = [&](auto& sweep, const std::array<bool, group_count>& sources, bool rates) {
    sweep.template use<Sweeps::pressure>() = {options_.pressure, true, sources, {}};
    sweep.template use<Sweeps::energy>() = {options_.energy, rates, sources, {}};
    sweep.template use<Sweeps::continuity>() = {continuity, rates && options_.takes_density_rate(), sources, {}};
    sweep.template use<Sweeps::artificial>() = {
        chosen(options_.artificial), options_.artificial.has_value(), sources, {}};
    sweep.template use<Sweeps::conductivity>() = {
        chosen(options_.conductivity), rates && options_.conductivity.has_value(), sources, {}};
    sweep.template use<Sweeps::stress>() = {chosen(options_.stress), options_.stress.has_value(), sources, {}};
    sweep.template use<Sweeps::signal>() = {{}, rates, sources, {}};
    sweep.take_from(sources);  // wall particles that only repel are none of its neighbours
  };
  set(force_, from, true);
  set(wall_force_, from_fluid, false);

  const terms::Repulsion repulsion = options_.repulsion.value_or(terms::Repulsion{});
  push_.template use<0>() = {repulsion, options_.repulsion.has_value(), {false, true}, {}};
  pushed_back_.template use<0>() = {repulsion, options_.repulsion.has_value(), from_fluid, {}};
  push_.template use<1>().active = pushed_back_.template use<1>().active = false;
}

/// What one evaluation of the rates consists of. The order follows from what the stages read and write.
template <int N>
void Gas<N>::make_plan() {
  add_density_stages();
  const rules::ApplyThermalEquationOfState state{options_.materials};
  this->add_update("equation of state", Group::fluid, state);
  if (held_) this->add_update("equation of state of walls", Group::wall, state);
  // One where nothing computes them.
  FieldSet ones;
  if (!options_.iterates()) ones |= Fields<omega>::set();
  if (!(options_.artificial && options_.limiter)) ones |= Fields<balsara>::set();
  add_ghost_stage("ghosts' state", Fields<rho, p, c, e, omega, alpha_v>::set() | ones);
  add_gradient_stages();
  this->add_sweep(force_, answered());
  if (options_.repulsion) this->add_sweep(push_, true);
  this->add_body_force_stage(options_.repulsion.has_value());
  if (options_.foresees()) {
    add_ghost_stage("ghosts' acceleration", Fields<acc>::set());
    this->add_sweep(foresight_, mirrored_);
  }

  Resources at_rest(Group::fluid, ones);
  // No friction: the stress in walls that answer stays 0.
  if (held_) at_rest.add(Group::wall, Fields<omega, balsara, stress>::set());
  FieldSet given = Fields<x, v, m, rho, e, h, alpha_v, x_list>::set();
  if (options_.smoothing == SmoothingLaw::density) given |= Fields<rho_0>::set();
  if (options_.stress) given |= Fields<mu>::set();
  this->finish_plan({given, Fields<p, c, acc, de, drho, v_signal, omega, balsara>::set(),
                     Fields<acc_old, x_start, v_start, rho_start>::set(), at_rest});
  for (const int f : {omega::id, balsara::id})
    if (held_ || ones[static_cast<std::size_t>(f)]) std::ranges::fill(store_.raw(f), 1.0);
}

template <int N>
void Gas<N>::add_density_stages() {
  this->add_summation_stages(options_.density, answered());
  if (!options_.iterates()) return;
  Resources reads(Group::fluid, Fields<x, m, h>::set());
  if (answered()) reads.add(Group::wall, Fields<x, m>::set());
  plan_.add({"density and support", reads, Resources(Group::fluid, Fields<h, rho, omega, rho_sum, rho_sum_h>::set()),
             [this] { find_supports(); }});
}

/// What follows from the velocity gradient.
template <int N>
void Gas<N>::add_gradient_stages() {
  if (!options_.takes_velocity_gradient()) return;
  this->add_sweep(gradient_, answered());
  FieldSet answer;
  if (options_.artificial && options_.limiter) {
    this->add_update("limiter", Group::fluid, rules::LimitViscosity<N>{options_.support.kappa});
    answer |= Fields<balsara>::set();
  }
  if (options_.stress) {
    this->add_update("viscous stress", Group::fluid, rules::TakeViscousStress<N>{});
    answer |= Fields<stress>::set();
  }
  if (answer.any()) add_ghost_stage("ghosts' viscosity", answer);
}

template <int N>
void Gas<N>::add_ghost_stage(const char* name, const FieldSet& fields) {
  if (!mirrored_) return;
  plan_.add({name, Resources(Group::fluid, fields), Resources(Group::wall, fields),
             [this, fields] { ghosts_->mirror(store_, fields); }});
}

/// Updates that the lists must see, after a look at what the moves left.
template <int N>
void Gas<N>::prepare() {
  check_state();
  if (options_.smoothing == SmoothingLaw::density)
    update(store_, Group::fluid, rules::FollowDensity<N>{options_.support.uniform});
}

template <int N>
void Gas<N>::check_state() const {
  const auto energy = store_.template get<e>(), density = store_.template get<rho>();
  const auto bad = [&](std::size_t i) { return !(energy[i] >= 0) || !(density[i] > 0); };
  if (total_over(store_, Group::fluid, [&](std::size_t i) { return bad(i) ? 1.0 : 0.0; }) == 0) return;
  const IndexRange fluid = store_.range(Group::fluid);
  std::size_t i = fluid.begin;
  while (!bad(i)) ++i;
  const bool cold = !(energy[i] >= 0);
  const bool finite = std::isfinite(energy[i]) && std::isfinite(density[i]);
  throw StateError(
      finite ? Trouble::energy : Trouble::not_finite, store_.ids()[i],
      {.what = fmt::format("the {} of particle {} is {:.4g} {} at t = {:.6g} s", cold ? "internal energy" : "density",
                           store_.ids()[i], cold ? energy[i] : density[i], cold ? "J/kg" : "kg/m^3", time_),
       .why = fmt::format("it lost more than it had in one step; rho = {:.4g} kg/m^3, e = {:.4g} J/kg", density[i],
                          energy[i]),
       .fix = "take a smaller step (time.courant), or more artificial viscosity"});
}

template <int N>
void Gas<N>::kick(double dt) {
  Flow<N>::kick(dt);
  auto energy = store_.template get<e>();
  const auto rate = store_.template get<de>();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) { energy[i] += dt * rate[i]; });
}

/// Density by its rate, and H where it has a rate of its own: the mean density of the step makes that second order.
template <int N>
void Gas<N>::compress(double dt) {
  foresee_supports(dt);
  if (!options_.takes_density_rate()) return;
  auto density = store_.template get<rho>(), H = store_.template get<h>();
  const auto rate = store_.template get<drho>();
  const bool grows = options_.smoothing == SmoothingLaw::continuity, evolves = options_.density == DensityForm::evolved;
  for_each_particle(store_, Group::fluid, [&](std::size_t i) {
    const double change = dt * rate[i];
    if (grows) H[i] *= std::exp(-change / (N * (density[i] + 0.5 * change)));
    if (evolves) density[i] += change;
  });
}

template <int N>
void Gas<N>::continuity() {
  if (!options_.takes_density_rate()) return;
  this->refresh_lists();
  this->run(rate_);
}

template <int N>
std::vector<typename Flow<N>::Evolved> Gas<N>::evolved() const {
  auto all = Flow<N>::evolved();
  all.push_back({Group::fluid, e::id, {de::id}});
  if (options_.density == DensityForm::evolved) all.push_back({Group::fluid, rho::id, {drho::id}});
  return all;
}

template <int N>
void Gas<N>::predict_kick(double dt) {
  de_before_.take(store_, Group::fluid, de::id);
  Flow<N>::predict_kick(dt);
}

template <int N>
void Gas<N>::correct_kick(double dt) {
  Flow<N>::correct_kick(dt);
  auto energy = store_.template get<e>();
  const auto rate = store_.template get<de>();
  for_each_particle(store_, Group::fluid,
                    [&](std::size_t i) { energy[i] += dt * (rate[i] - de_before_.of(store_.ids()[i])[0]); });
}

/// The end of a step: the viscosity switch moves on.
template <int N>
void Gas<N>::smooth() {
  const double dt = time_ - this->step_end();
  Flow<N>::smooth();
  if (!options_.switches()) return;
  auto chosen = options_.viscosity_switch;
  chosen.with_chosen([&]<class Switch>(const Switch& rule) {
    using Reads = typename Switch::reads;
    auto alpha = store_.template get<alpha_v>();
    const auto H = store_.template get<h>();
    for_each_particle(store_, Group::fluid, [&](std::size_t i) {
      typename Reads::template Row<N, double> a;
      Reads::for_each([&]<class F>(F) { F::of(a) = store_.template get<F>()[i]; });
      alpha[i] = rule.template next<N>(a, {dt, H[i] / options_.support.kappa, H[i]});
    });
  });
}

template <int N>
void Gas<N>::save() {
  Flow<N>::save();
  e_start_.take(store_, Group::fluid, e::id);
  h_start_.take(store_, Group::fluid, h::id);
}

template <int N>
void Gas<N>::restore() {
  Flow<N>::restore();
  e_start_.give_back(store_, Group::fluid, e::id);
  h_start_.give_back(store_, Group::fluid, h::id);
}

/// What each term took out of kinetic and internal energy together: nothing, where heat is what motion lost.
template <int N>
void Gas<N>::book(double dt) {
  constexpr int fluid = 0, wall = 1;
  const Power& pressure = force_.template use<Sweeps::pressure>().power;
  const Power& work = force_.template use<Sweeps::energy>().power;
  const Power& artificial = force_.template use<Sweeps::artificial>().power;
  const Power& heat = force_.template use<Sweeps::conductivity>().power;
  const Power& viscous = force_.template use<Sweeps::stress>().power;
  ledger_.exchange -= dt * (pressure[fluid] + work[fluid]);
  ledger_.artificial -= dt * artificial[fluid];
  ledger_.diffusion -= dt * heat[fluid];
  ledger_.viscous -= dt * viscous[fluid];
  ledger_.walls -= dt * (pressure[wall] + work[wall] + artificial[wall] + heat[wall] + viscous[wall]);
  if (options_.repulsion) ledger_.walls -= dt * push_.template use<0>().power[wall];
  ledger_.body -= dt * body_power_;
}

template <int N>
Step Gas<N>::stable_step(const StepLimits& limits) const {
  if (limits.fixed > 0) return {limits.fixed, "fixed"};
  const auto H = store_.template get<h>();
  const auto signal = store_.template get<v_signal>();
  const auto a = store_.template get<acc>();
  const auto viscosity = store_.template get<mu>();
  const auto density = store_.template get<rho>();
  const double kappa = options_.support.kappa;
  const bool viscous = options_.stress.has_value();
  const auto fastest = largest_over(store_, Group::fluid, Vec<3>{}, [&](std::size_t i) {
    const double rate = kappa / H[i];
    return Vec<3>{{signal[i] * rate, norm_sq(a[i]) * sq(rate), viscous ? viscosity[i] / density[i] * sq(rate) : 0.0}};
  });
  return shortest_step(limits, {fastest[0], fastest[1], fastest[2]});
}

template <int N>
Energies Gas<N>::energies() const {
  const auto mass = store_.template get<m>(), energy = store_.template get<e>();
  Energies all = this->energies_of_motion();
  all.elastic = total_over(store_, Group::fluid, [&](std::size_t i) { return mass[i] * energy[i]; });
  return all;
}

template <int N>
void Gas<N>::evaluate_wall_forces() {
  if (answered()) this->run(wall_force_);
  if (!options_.repulsion) return;
  this->run(pushed_back_);
  auto a = store_.template get<acc>();
  const auto push = store_.template get<acc_wall>();
  for_each_particle(store_, Group::wall, [&](std::size_t i) { a[i] = held_ ? a[i] + push[i] : push[i]; });
}

template <int N>
std::vector<double*> Gas<N>::remembered() {
  std::vector<double*> numbers{&body_power_};
  std::ranges::copy(this->accounts(), std::back_inserter(numbers));
  this->remember_powers(force_, numbers);
  if (options_.repulsion) this->remember_powers(push_, numbers);
  return numbers;
}

}  // namespace undine
