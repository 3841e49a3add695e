#pragma once
// The definitions of WeaklyCompressible<N>, compiled once for each N in weakly_compressible_Nd.cpp.
#include <fmt/format.h>

#include "undine/core/stopwatch.hpp"
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
    : store_(std::move(store)),
      domain_(domain),
      options_(std::move(options)),
      neighbours_(domain_, options_.neighbours) {
  if (options_.mirrors) ghosts_.emplace(options_.mirrors, domain_);
  configure();
  make_plan();
  if (memory.empty()) {
    move_walls();
    evaluate();
  } else {
    recall(memory);
  }
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

  auto continuity = options_.continuity;
  // A summed density changes as its derivative says, whichever continuity form the case names.
  if (options_.density != DensityForm::evolved) continuity.choose(terms::ContinuityForms::index<terms::Continuity>());

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
  summation_.template use<0>() = {{}, true, {true, walls}, {}};
  shepard_.template use<0>() = {{}, true, {true, walls}, {}};
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

  wall_force_.template use<0>() = {options_.pressure, true, {true, false}, {}};
  wall_force_.template use<1>() = {
      chosen(options_.viscosity), options_.viscosity && friction && !holds(), {true, false}, {}};
  wall_force_.template use<2>() = {chosen(options_.artificial), options_.artificial && friction, {true, false}, {}};
}

/// What one evaluation of the rates consists of. The order follows from what the stages read and write.
template <int N>
void WeaklyCompressible<N>::make_plan() {
  const bool walls = options_.wall_density != WallDensity::none;

  add_density_stages();
  add_update("equation of state", Group::fluid, rules::ApplyEquationOfState{options_.materials});
  if (walls) add_wall_stages();
  if (renormalises()) {
    add_sweep(gradient_, false);
    add_update("renormalised gradient", Group::fluid, rules::RenormaliseGradient<N>{});
  }
  add_sweep(force_, walls);
  if (pushes()) add_push_stages();
  if (options_.strain_dissipation) add_strain_stage();
  if (norm_sq(options_.gravity) > 0 || options_.body_force || pushes()) {
    const Resources changed(Group::fluid, Fields<acc>::set());
    Resources reads = Resources(changed).add(Group::fluid, Fields<x, v, m>::set());
    if (pushes()) reads.add(Group::fluid, Fields<acc_wall>::set());
    plan_.add({"body force", reads, changed, [this] {
                 auto a = store_.template get<acc>();
                 const auto at = store_.template get<x>();
                 const auto u = store_.template get<v>();
                 const auto mass = store_.template get<m>();
                 const auto push = store_.template get<acc_wall>();
                 body_power_ = total_over(store_, Group::fluid, [&](std::size_t i) {
                   if (!push.empty()) a[i] += push[i];
                   a[i] += options_.gravity;
                   if (!options_.body_force) return 0.0;
                   const Vec<N> imposed = options_.body_force(at[i], time_);
                   a[i] += imposed;
                   return mass[i] * dot(imposed, u[i]);
                 });
               }});
  }

  FieldSet given_fields = Fields<x, v, m, rho, x_list>::set();
  const auto give = [&](bool needed, const FieldSet& fields) {
    if (needed) given_fields |= fields;
  };
  give(walls || options_.repulsion || options_.rho_law, Fields<rho_0>::set());
  give(options_.wall_density == WallDensity::modified, Fields<rho_wall>::set());
  give(options_.viscosity || options_.strain_dissipation, Fields<mu>::set());
  give(options_.rho_law, Fields<h>::set());
  Resources given;
  for (const Group g : all_groups) given.add(g, given_fields);
  FieldSet used = given_fields | Fields<p, c, acc, drho, mu_cfl>::set();
  for (const auto& stage : plan_.stages()) used |= stage.reads.fields() | stage.writes.fields();
  // A run that goes on also has what integrators keep of a step.
  store_.keep(used | options_.kept | Fields<acc_old, x_start, v_start, rho_start>::set());
  store_.allocate(used);
  // Terms that are not in use leave these at zero, and so do walls.
  given.add(Group::fluid, Fields<grad_rho_l>::set()).add(Group::wall, Fields<grad_rho_l, p, c>::set());
  plan_.order(given);
}

template <int N>
void WeaklyCompressible<N>::add_density_stages() {
  if (options_.density == DensityForm::evolved) return;
  if (options_.density == DensityForm::summation) {
    add_sweep(summation_, options_.wall_density != WallDensity::none);
    add_update("summed density", Group::fluid, rules::TakeSummedDensity{});
    return;
  }
  // The Shepard sum takes the volumes of the density before, so the three belong together and change rho in place.
  const Resources touched(Group::fluid, Fields<rho, rho_sum, w_sum>::set());
  Resources reads(Group::fluid, Fields<m, rho>::set() | place());
  if (options_.wall_density != WallDensity::none) reads.add(Group::wall, Fields<m>::set() | place());
  // Ghosts too have the density of before, and take the new one afterwards.
  if (options_.wall_density != WallDensity::none && !ghosts_) reads.add(Group::wall, Fields<rho>::set());
  plan_.add({"normalised density", reads, touched, [this] {
               run(summation_);
               run(shepard_);
               update(store_, Group::fluid, rules::TakeNormalisedDensity{});
             }});
}

/// Dissipation by the velocity gradient L: 2 mu D:D per volume, D = (L + L^T)/2. Saalfeld (2012), eq. 51-54 (with the
/// factor 2).
template <int N>
void WeaklyCompressible<N>::add_strain_stage() {
  add_sweep(strain_, options_.wall_density != WallDensity::none);
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

template <int N>
template <class Sweep>
void WeaklyCompressible<N>::add_sweep(Sweep& sweep, bool from_walls) {
  Resources reads(Group::fluid, sweep.reads() | place());
  if (from_walls) reads.add(Group::wall, sweep.reads() | place());
  reads.add(sweep.target(), sweep.target_reads() | place());
  plan_.add({sweep.name(), reads, Resources(sweep.target(), sweep.adds()), [this, &sweep] { run(sweep); }});
  sweeps_.push_back({sweep.name(), [this, &sweep] { return sweep.path(context(), options_.backend); },
                     [this, &sweep] { return sweep.unusual(context(), options_.backend); }});
}

template <int N>
template <class Update>
void WeaklyCompressible<N>::add_update(std::string name, Group group, const Update& rule) {
  plan_.add({std::move(name), Resources(group, Update::reads::set()), Resources(group, Update::writes::set()),
             [this, group, rule] { update(store_, group, rule); }});
}

template <int N>
std::string WeaklyCompressible<N>::describe_sweeps() const {
  std::string text;
  for (const SweepNote& sweep : sweeps_) {
    const std::string why = sweep.unusual();
    text += fmt::format("{}{}: {}{}", text.empty() ? "" : "; ", sweep.name,
                        sweep_path_names[static_cast<std::size_t>(sweep.path())],
                        why.empty() ? "" : fmt::format(" ({})", why));
  }
  return text;
}

template <int N>
SweepContext<N> WeaklyCompressible<N>::context() {
  Support support = options_.support;
  support.per_particle = options_.rho_law;
  return {store_, neighbours_, domain_, support, options_.kernels, options_.materials.front().rho_0};
}

template <int N>
template <class Sweep>
void WeaklyCompressible<N>::run(Sweep& sweep) {
  const Stopwatch watch(seconds_sweeps_);
  sweep.run(context(), options_.backend);
}

template <int N>
double WeaklyCompressible<N>::largest_support() const {
  if (!options_.rho_law) return options_.support.uniform;
  const auto H = store_.template get<h>();
  double largest = 0;
  for (const Group g : all_groups) largest = largest_over(store_, g, largest, [&](std::size_t i) { return H[i]; });
  return largest;
}

template <int N>
void WeaklyCompressible<N>::refresh_lists() {
  const Stopwatch watch(seconds_lists_);
  if (ghosts_) ghosts_->follow(store_);
  support_now_ = largest_support();
  if (!neighbours_.stale(store_, support_now_)) return;
  check_support();
  check_particles();
  if (ghosts_) ghosts_->make(store_, support_now_ * (1 + options_.neighbours.skin));
  neighbours_.build(store_, support_now_);
  if (ghosts_) ghosts_->find_parents(store_);
  ++list_builds_;
}

/// H that follows the density may outgrow what was checked when the case was read.
template <int N>
void WeaklyCompressible<N>::check_support() const {
  const double reach = support_now_ * (1 + options_.neighbours.skin);
  for (int k = 0; k < N; ++k)
    if (domain_.periodic[k] && domain_.length(k) < 2 * reach)
      throw RunError(
          {.what = fmt::format("H has grown to {:.4g} m at t = {:.6g} s, too large for the period of {:.4g} m",
                               support_now_, time_, domain_.length(k)),
           .why = "a particle would see another one and its image",
           .fix = "widen the domain, or take a constant H (scheme.smoothing.law)"});
  if (ghosts_ && support_now_ > options_.support.uniform * (1 + 1e-9))
    throw RunError({.what = fmt::format("H has grown to {:.4g} m at t = {:.6g} s, from {:.4g} m", support_now_, time_,
                                        options_.support.uniform),
                    .why = "walls with ghosts were checked for gaps and thickness with the H of the start",
                    .fix = "take a constant H (scheme.smoothing.law), or other walls"});
}

/// A fluid particle that left the domain ends the run, or leaves it with its energy.
template <int N>
void WeaklyCompressible<N>::check_particles() {
  const auto at = store_.template get<x>();
  const IndexRange fluid = store_.range(Group::fluid);
  std::vector<char> gone;
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const bool finite = std::isfinite(norm_sq(at[i]));
    if (domain_.contains(at[i]) && finite) continue;
    if (options_.lets_escape && finite) {
      gone.resize(store_.size());
      gone[i] = 1;
      ++escaped_;
      continue;
    }
    std::string place;
    for (int k = 0; k < N; ++k) place += fmt::format("{}{:.6g}", k ? ", " : "", at[i][k]);
    throw RunError(
        {.what = fmt::format("particle {} left the domain at t = {:.6g} s: x = ({}) m", store_.ids()[i], time_, place),
         .why = "it passed a wall, or was thrown out by a pressure that grew beyond bounds",
         .fix = "take a smaller time step, a larger speed of sound, a tight wall ('combined') or a larger [domain]"});
  }
  if (gone.empty()) return;
  const double before = energies().total();
  store_.remove(gone);
  const double taken = before - energies().total();
  ledger_.walls += taken;
  ledger_start_.walls += taken;  // which a step that goes back to its start returns to
}

template <int N>
void WeaklyCompressible<N>::evaluate() {
  // Before the lists, which must reach as far as the largest support.
  if (options_.rho_law) update(store_, Group::fluid, rules::FollowDensity<N>{options_.support.uniform});
  refresh_lists();
  plan_.run();
  const auto a = store_.template get<acc>();
  const double sum = total_over(store_, Group::fluid, [&](std::size_t i) { return norm_sq(a[i]); });
  if (std::isfinite(sum)) return;
  const IndexRange fluid = store_.range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i)
    if (!std::isfinite(norm_sq(a[i])))
      throw RunError(
          {.what = fmt::format("the acceleration of particle {} is not finite at t = {:.6g} s", store_.ids()[i], time_),
           .why = fmt::format("rho = {:.6g} kg/m^3, p = {:.6g} Pa", store_.template get<rho>()[i],
                              store_.template get<p>()[i]),
           .fix = "take a smaller time step, or a kernel fit for pressure"});
}

template <int N>
void WeaklyCompressible<N>::drift(double dt) {
  auto at = store_.template get<x>();
  auto u = store_.template get<v>();
  const auto mass = store_.template get<m>();
  const auto correction = store_.template get<v_xsph>();
  const auto& g = options_.gravity;
  const bool moves = options_.xsph && options_.xsph_target == XsphTarget::position;
  struct Work {
    double xsph = 0, walls = 0;
    Work& operator+=(const Work& o) {
      xsph += o.xsph;
      walls += o.walls;
      return *this;
    }
  };
  place_surfaces(time_ + dt);
  const Work work = total_over(store_, Group::fluid, [&](std::size_t i) {
    const Vec<N> from = at[i];
    const Vec<N> moved = moves ? correction[i] : Vec<N>{};
    Vec<N> to = from + dt * (u[i] + moved);
    Work done{mass[i] * dot(g, dt * moved), 0};
    if (options_.reflector) {
      const Bounce<N> bounce = options_.reflector(from, to, u[i]);
      done.walls = mass[i] * (dot(g, bounce.x - to) + 0.5 * (norm_sq(u[i]) - norm_sq(bounce.v)));
      to = bounce.x;
      u[i] = bounce.v;
    }
    at[i] = to;
    return done;
  });
  ledger_.xsph += work.xsph;
  ledger_.walls += work.walls;
  time_ += dt;
  move_walls();
}

template <int N>
void WeaklyCompressible<N>::kick(double dt) {
  auto u = store_.template get<v>();
  const auto a = store_.template get<acc>();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) { u[i] += dt * a[i]; });
}

template <int N>
void WeaklyCompressible<N>::compress(double dt) {
  auto density = store_.template get<rho>();
  const auto rate = store_.template get<drho>();
  const auto diffused = store_.template get<drho_diff>();
  if (options_.density == DensityForm::evolved)
    for_each_particle(store_, Group::fluid, [&, diffuses = diffuses()](std::size_t i) {
      density[i] += dt * (diffuses ? rate[i] + diffused[i] : rate[i]);
    });
  if (options_.wall_density == WallDensity::evolved)
    for_each_particle(store_, Group::wall, [&](std::size_t i) {
      density[i] += dt * rate[i];
      if (!options_.wall_pulls) density[i] = std::max(density[i], store_.template get<rho_0>()[i]);
    });
}

template <int N>
void WeaklyCompressible<N>::continuity() {
  if (options_.density == DensityForm::evolved || options_.wall_density == WallDensity::evolved) refresh_lists();
  if (options_.density == DensityForm::evolved) run(continuity_);
  if (options_.wall_density == WallDensity::evolved) run(wall_continuity_);
}

template <int N>
void WeaklyCompressible<N>::predict_kick(double dt) {
  store_.allocate(Fields<acc_old>::set());
  auto old = store_.template get<acc_old>();
  const auto a = store_.template get<acc>();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) { old[i] = a[i]; });
  kick(dt);
}

template <int N>
void WeaklyCompressible<N>::correct_kick(double dt) {
  auto u = store_.template get<v>();
  const auto a = store_.template get<acc>();
  const auto old = store_.template get<acc_old>();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) { u[i] += dt * (a[i] - old[i]); });
}

/// What acts once a step: pushes of surfaces, and XSPH on the velocity itself. What it takes from the kinetic energy is
/// booked exactly.
template <int N>
void WeaklyCompressible<N>::smooth() {
  if (options_.pushed_out) push_from_walls(time_ - step_end_);
  step_end_ = time_;
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

template <int N>
void WeaklyCompressible<N>::save() {
  store_.allocate(Fields<x_start, v_start, rho_start>::set());
  std::ranges::copy(store_.template get<x>(), store_.template get<x_start>().begin());
  std::ranges::copy(store_.template get<v>(), store_.template get<v_start>().begin());
  std::ranges::copy(store_.template get<rho>(), store_.template get<rho_start>().begin());
  time_start_ = time_;
  ledger_start_ = ledger_;
}

template <int N>
void WeaklyCompressible<N>::restore() {
  std::ranges::copy(store_.template get<x_start>(), store_.template get<x>().begin());
  std::ranges::copy(store_.template get<v_start>(), store_.template get<v>().begin());
  std::ranges::copy(store_.template get<rho_start>(), store_.template get<rho>().begin());
  time_ = time_start_;
  ledger_ = ledger_start_;
}

template <int N>
void WeaklyCompressible<N>::book(double dt) {
  constexpr int fluid = 0, wall = 1;
  const Power& pressure = force_.template use<Sweeps::pressure>().power;
  const Power& compression = force_.template use<Sweeps::continuity>().power;
  const Power& viscous = force_.template use<Sweeps::viscosity>().power;
  const Power& artificial = force_.template use<Sweeps::artificial>().power;
  const Power& diffusion = force_.template use<Sweeps::diffusion>().power;
  ledger_.viscous -= dt * viscous[fluid];
  ledger_.artificial -= dt * artificial[fluid];
  ledger_.diffusion -= dt * (diffusion[fluid] + diffusion[wall]);
  ledger_.exchange -= dt * (pressure[fluid] + compression[fluid]);
  ledger_.walls -= dt * (pressure[wall] + compression[wall] + viscous[wall] + artificial[wall]);
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
    const double rate = kappa / (options_.rho_law ? H[i] : options_.support.uniform);
    return Vec<3>{{(sound[i] + approach[i]) * rate, norm_sq(a[i]) * sq(rate),
                   viscous ? viscosity[i] / density[i] * sq(rate) : 0.0}};
  });

  Step step{limits.largest, "largest"};
  const auto limit = [&](double dt, const char* name) {
    if (dt < step.dt) step = {dt, name};
  };
  limit(limits.courant / fastest[0], "courant");
  limit(limits.force / std::sqrt(std::sqrt(fastest[1])), "force");
  if (viscous) limit(limits.viscous / fastest[2], "viscous");
  return step;
}

template <int N>
Energies WeaklyCompressible<N>::energies() const {
  const auto at = store_.template get<x>();
  const auto u = store_.template get<v>();
  const auto mass = store_.template get<m>();
  const auto density = store_.template get<rho>();
  const auto material = store_.materials();
  const auto sum = [&](auto&& f) { return total_over(store_, Group::fluid, f); };
  Energies e;
  e.kinetic = sum([&](std::size_t i) { return 0.5 * mass[i] * norm_sq(u[i]); });
  e.potential = -sum([&](std::size_t i) { return mass[i] * dot(options_.gravity, at[i] - potential_origin_); });
  e.elastic = sum([&](std::size_t i) { return mass[i] * options_.materials[material[i]].energy(density[i]); });
  e.ledger = ledger_;
  e.strain_power = strain_power_;
  e.strain_dissipated = strain_dissipated_;
  return e;
}

template <int N>
template <class Self, class F>
void WeaklyCompressible<N>::for_each_booked_power(Self& self, F&& f) {
  const auto each = [&](auto&... use) { (f(use.power), ...); };
  std::apply(each, self.force_.uses());
  if (self.pushes()) std::apply(each, self.push_.uses());
}

template <int N>
std::vector<double> WeaklyCompressible<N>::memory() const {
  std::vector<double> numbers{time_, neighbours_.support(), body_power_, strain_power_, strain_dissipated_};
  const auto& l = ledger_;
  numbers.insert(numbers.end(), {l.viscous, l.artificial, l.diffusion, l.exchange, l.walls, l.xsph, l.body});
  for_each_booked_power(*this, [&](const Power& power) { numbers.insert(numbers.end(), power.begin(), power.end()); });
  numbers.push_back(static_cast<double>(escaped_));
  return numbers;
}

template <int N>
void WeaklyCompressible<N>::recall(const std::vector<double>& numbers) {
  auto next = numbers.begin();
  time_ = *next++;
  neighbours_.rebuild_from_list_positions(store_, *next++);
  if (ghosts_) ghosts_->find_parents(store_);
  body_power_ = *next++;
  strain_power_ = *next++;
  strain_dissipated_ = *next++;
  auto& l = ledger_;
  for (double* account : {&l.viscous, &l.artificial, &l.diffusion, &l.exchange, &l.walls, &l.xsph, &l.body})
    *account = *next++;
  for_each_booked_power(*this, [&](Power& power) {
    for (double& number : power) number = *next++;
  });
  step_end_ = time_;
  support_now_ = largest_support();
  escaped_ = static_cast<long>(*next++);
  place_surfaces(time_);
}

}  // namespace undine

#include "undine/schemes/weakly_compressible_walls_impl.hpp"
