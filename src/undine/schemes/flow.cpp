#include "undine/schemes/flow.hpp"

#include <cmath>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/schemes/flow_density_impl.hpp"
#include "undine/schemes/flow_stages_impl.hpp"
#include "undine/schemes/state_error.hpp"

namespace undine {

using namespace field;

namespace {

template <int N>
typename Neighbours<N>::Options list_options(const FlowOptions<N>& options) {
  auto lists = options.neighbours;
  lists.own_supports = options.supports_vary();
  return lists;
}

}  // namespace

template <int N>
Flow<N>::Flow(Store<N> store, const Domain<N>& domain, std::shared_ptr<const FlowOptions<N>> options)
    : store_(std::move(store)),
      domain_(domain),
      neighbours_(domain_, list_options(*options)),
      common_(std::move(options)) {
  if (common_->mirrors) ghosts_.emplace(common_->mirrors, domain_);
}

template <int N>
void Flow<N>::start(const std::vector<double>& memory) {
  if (memory.empty()) {
    move_walls();
    evaluate();
  } else {
    recall(memory);
  }
}

template <int N>
void Flow<N>::add_body_force_stage(bool walls_push) {
  if (norm_sq(common_->gravity) == 0 && !common_->body_force && !walls_push) return;
  const Resources changed(Group::fluid, Fields<acc>::set());
  Resources reads = Resources(changed).add(Group::fluid, Fields<x, v, m>::set());
  if (walls_push) reads.add(Group::fluid, Fields<acc_wall>::set());
  plan_.add({"body force", reads, changed, [this] {
               auto a = store_.template get<acc>();
               const auto at = store_.template get<x>();
               const auto u = store_.template get<v>();
               const auto mass = store_.template get<m>();
               const auto push = store_.template get<acc_wall>();
               body_power_ = total_over(store_, Group::fluid, [&](std::size_t i) {
                 if (!push.empty()) a[i] += push[i];
                 a[i] += common_->gravity;
                 if (!common_->body_force) return 0.0;
                 const Vec<N> imposed = common_->body_force(at[i], time_);
                 a[i] += imposed;
                 return mass[i] * dot(imposed, u[i]);
               });
             }});
}

template <int N>
void Flow<N>::finish_plan(const PlanFields& fields) {
  Resources given = fields.at_rest;
  for (const Group g : all_groups) given.add(g, fields.given);
  FieldSet used = fields.given | fields.used;
  if (common_->supports_vary()) used |= Fields<h_list>::set();
  for (const auto& stage : plan_.stages()) used |= stage.reads.fields() | stage.writes.fields();
  // A run that goes on also has what integrators keep of a step.
  store_.keep(used | common_->kept | fields.kept);
  store_.allocate(used);
  plan_.order(given);
}

template <int N>
std::string Flow<N>::describe_sweeps() const {
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
SweepContext<N> Flow<N>::context(Store<N>& store, const Neighbours<N>& neighbours) const {
  return {store, neighbours, domain_, common_->support_in_use(), common_->kernels, common_->materials.front().rho_0};
}

template <int N>
InterpolationSource<N> Flow<N>::interpolation_source() const {
  const auto& kernel = common_->kernels[static_cast<std::size_t>(KernelRole::density)];
  return {store_, neighbours_, domain_, kernel, common_->support_in_use(), wall_volume()};
}

template <int N>
double Flow<N>::largest_support() const {
  if (!common_->supports_vary()) return common_->support.uniform;
  const auto H = store_.template get<h>();
  double largest = 0;
  for (const Group g : all_groups) largest = largest_over(store_, g, largest, [&](std::size_t i) { return H[i]; });
  return largest;
}

template <int N>
void Flow<N>::refresh_lists() {
  const Stopwatch watch(seconds_lists_);
  if (ghosts_) ghosts_->follow(store_);
  support_now_ = largest_support();
  if (!neighbours_.stale(store_, support_now_)) return;
  check_support();
  check_particles();
  if (ghosts_) ghosts_->make(store_, support_now_ * (1 + common_->neighbours.skin));
  neighbours_.build(store_, support_now_);
  if (ghosts_) ghosts_->find_parents(store_);
  ++list_builds_;
}

/// H that follows the density may outgrow what was checked when the case was read.
template <int N>
void Flow<N>::check_support() const {
  const double reach = support_now_ * (1 + common_->neighbours.skin);
  const auto widest = [&] {
    const auto H = store_.template get<h>();
    const IndexRange fluid = store_.range(Group::fluid);
    if (H.empty() || fluid.size() == 0) return std::int64_t{-1};
    const auto own = H.subspan(fluid.begin, fluid.size());
    return store_.ids()[fluid.begin + static_cast<std::size_t>(std::ranges::max_element(own) - own.begin())];
  };
  for (int k = 0; k < N; ++k)
    if (domain_.periodic[k] && domain_.length(k) < 2 * reach)
      throw StateError(
          Trouble::support, widest(),
          {.what = fmt::format("H has grown to {:.4g} m at t = {:.6g} s, too large for the period of {:.4g} m",
                               support_now_, time_, domain_.length(k)),
           .why = "a particle would see another one and its image",
           .fix = "widen the domain, or take a constant H (scheme.smoothing.law)"});
  const double mirrored = std::max(common_->mirrored_support, common_->support.uniform);
  if (ghosts_ && support_now_ > mirrored * (1 + 1e-9))
    throw StateError(
        Trouble::support, widest(),
        {.what = fmt::format("H has grown to {:.4g} m at t = {:.6g} s, from {:.4g} m", support_now_, time_,
                             common_->support.uniform),
         .why = fmt::format("walls with ghosts were checked for gaps and thickness with H up to {:.4g} m", mirrored),
         .fix = "take a constant H (scheme.smoothing.law), or other walls"});
}

/// A fluid particle that left the domain ends the run, or leaves it with its energy.
template <int N>
void Flow<N>::check_particles() {
  const auto at = store_.template get<x>();
  const IndexRange fluid = store_.range(Group::fluid);
  std::vector<char> gone;
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const bool finite = std::isfinite(norm_sq(at[i]));
    if (domain_.contains(at[i]) && finite) continue;
    if (common_->lets_escape && finite) {
      gone.resize(store_.size());
      gone[i] = 1;
      ++escaped_;
      continue;
    }
    std::string place;
    for (int k = 0; k < N; ++k) place += fmt::format("{}{:.6g}", k ? ", " : "", at[i][k]);
    throw StateError(
        finite ? Trouble::outside : Trouble::not_finite, store_.ids()[i],
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
void Flow<N>::evaluate() {
  prepare();
  refresh_lists();
  plan_.run();
  const auto a = store_.template get<acc>();
  const double sum = total_over(store_, Group::fluid, [&](std::size_t i) { return norm_sq(a[i]); });
  if (std::isfinite(sum)) return;
  const IndexRange fluid = store_.range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i)
    if (!std::isfinite(norm_sq(a[i])))
      throw StateError(
          Trouble::not_finite, store_.ids()[i],
          {.what = fmt::format("the acceleration of particle {} is not finite at t = {:.6g} s", store_.ids()[i], time_),
           .why = fmt::format("rho = {:.6g} kg/m^3, p = {:.6g} Pa", store_.template get<rho>()[i],
                              store_.template get<p>()[i]),
           .fix = "take a smaller time step, or a kernel fit for pressure"});
}

template <int N>
void Flow<N>::drift(double dt) {
  auto at = store_.template get<x>();
  auto u = store_.template get<v>();
  const auto mass = store_.template get<m>();
  const auto correction = drift_correction();
  const auto& g = common_->gravity;
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
    const Vec<N> moved = correction.empty() ? Vec<N>{} : correction[i];
    Vec<N> to = from + dt * (u[i] + moved);
    Work done{mass[i] * dot(g, dt * moved), 0};
    if (common_->reflector) {
      const Bounce<N> bounce = common_->reflector(from, to, u[i]);
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
void Flow<N>::kick(double dt) {
  auto u = store_.template get<v>();
  const auto a = store_.template get<acc>();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) { u[i] += dt * a[i]; });
}

template <int N>
void Flow<N>::predict_kick(double dt) {
  store_.allocate(Fields<acc_old>::set());
  auto old = store_.template get<acc_old>();
  const auto a = store_.template get<acc>();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) { old[i] = a[i]; });
  kick(dt);
}

template <int N>
void Flow<N>::correct_kick(double dt) {
  auto u = store_.template get<v>();
  const auto a = store_.template get<acc>();
  const auto old = store_.template get<acc_old>();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) { u[i] += dt * (a[i] - old[i]); });
}

/// What acts once a step: pushes of surfaces, and what smooths the density.
template <int N>
void Flow<N>::smooth() {
  if (common_->pushed_out) push_from_walls(time_ - step_end_);
  if (common_->density_filter) filter_density();
  step_end_ = time_;
}

template <int N>
void Flow<N>::save() {
  store_.allocate(Fields<x_start, v_start, rho_start>::set());
  std::ranges::copy(store_.template get<x>(), store_.template get<x_start>().begin());
  std::ranges::copy(store_.template get<v>(), store_.template get<v_start>().begin());
  std::ranges::copy(store_.template get<rho>(), store_.template get<rho_start>().begin());
  time_start_ = time_;
  ledger_start_ = ledger_;
}

template <int N>
void Flow<N>::restore() {
  std::ranges::copy(store_.template get<x_start>(), store_.template get<x>().begin());
  std::ranges::copy(store_.template get<v_start>(), store_.template get<v>().begin());
  std::ranges::copy(store_.template get<rho_start>(), store_.template get<rho>().begin());
  time_ = time_start_;
  ledger_ = ledger_start_;
}

template <int N>
std::vector<typename Flow<N>::Evolved> Flow<N>::evolved() const {
  std::vector<int> moves{v::id};
  if (!drift_correction().empty()) moves.push_back(v_xsph::id);
  return {{Group::fluid, x::id, moves}, {Group::fluid, v::id, {acc::id}}};
}

template <int N>
Energies Flow<N>::energies_of_motion() const {
  const auto at = store_.template get<x>();
  const auto u = store_.template get<v>();
  const auto mass = store_.template get<m>();
  const auto sum = [&](auto&& f) { return total_over(store_, Group::fluid, f); };
  Energies e;
  e.kinetic = sum([&](std::size_t i) { return 0.5 * mass[i] * norm_sq(u[i]); });
  e.potential = -sum([&](std::size_t i) { return mass[i] * dot(common_->gravity, at[i] - potential_origin_); });
  e.ledger = ledger_;
  return e;
}

template <int N>
std::vector<double*> Flow<N>::accounts() {
  auto& l = ledger_;
  return {&l.viscous, &l.artificial, &l.diffusion, &l.exchange, &l.walls, &l.xsph, &l.body};
}

template <int N>
std::vector<double> Flow<N>::memory() const {
  std::vector<double> numbers{time_, neighbours_.support(), control_.proposed, control_.error_before,
                              steps_since_filter_};
  for (const double* number : const_cast<Flow&>(*this).remembered()) numbers.push_back(*number);
  numbers.push_back(static_cast<double>(escaped_));
  return numbers;
}

template <int N>
void Flow<N>::recall(const std::vector<double>& numbers) {
  const std::size_t expected = remembered().size() + 6;
  if (numbers.size() != expected)
    throw InputError({.what = "the checkpoint is of another version of this program",
                      .why = fmt::format("it remembers {} numbers, this scheme {}", numbers.size(), expected),
                      .fix = "start again without --resume"});
  auto next = numbers.begin();
  time_ = *next++;
  neighbours_.rebuild_from_list_positions(store_, *next++);
  control_.proposed = *next++;
  control_.error_before = *next++;
  steps_since_filter_ = *next++;
  if (ghosts_) ghosts_->find_parents(store_);
  for (double* number : remembered()) *number = *next++;
  step_end_ = time_;
  support_now_ = largest_support();
  escaped_ = static_cast<long>(*next++);
  place_surfaces(time_);
}

/// What reflects, pushes or is asked for its depth is where its motion has it at t.
template <int N>
void Flow<N>::place_surfaces(double t) const {
  for (const auto& motion : common_->walls.motions)
    if (motion.place_surface) motion.place_surface(motion.state(t));
}

/// Walls are where their motion has them now.
template <int N>
void Flow<N>::move_walls() {
  const auto& walls = common_->walls;
  if (!walls.moves()) return;
  std::vector<typename WallMotion<N>::State> states;
  for (const auto& motion : walls.motions) states.push_back(motion.state(time_));
  auto at = store_.template get<x>();
  auto u = store_.template get<v>();
  for_each_particle(store_, Group::wall, [&](std::size_t i) {
    const auto k = static_cast<std::size_t>(store_.ids()[i] - walls.first_id);
    if (walls.motion[k] < 0) return;
    const auto which = static_cast<std::size_t>(walls.motion[k]);
    const Vec<N> place = walls.start[k] + states[which].displacement;
    at[i] = domain_.wrapped(place);
    u[i] = states[which].velocity;
    if (walls.motions[which].slide) u[i] += walls.motions[which].slide(place, time_);
  });
}

/// f = (l - r)/dt^2 along the normal, for a whole step: v changes by (l - r)/dt. Saalfeld (2012), eq. 58.
template <int N>
void Flow<N>::push_from_walls(double dt) {
  auto u = store_.template get<v>();
  const auto at = store_.template get<x>();
  const auto mass = store_.template get<m>();
  ledger_.walls += total_over(store_, Group::fluid, [&](std::size_t i) {
    const Vec<N> old = u[i];
    u[i] += (common_->pushed_out(at[i]) - at[i]) / dt;
    return 0.5 * mass[i] * (norm_sq(old) - norm_sq(u[i]));
  });
}

template class Flow<1>;
template class Flow<2>;
template class Flow<3>;

}  // namespace undine
