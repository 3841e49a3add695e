#include "undine/app/watchdog/collect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include "undine/app/watchdog/pair_survey.hpp"
#include "undine/app/watchdog/watch.hpp"
#include "undine/geometry/embed.hpp"
#include "undine/integrators/catalogue.hpp"
#include "undine/schemes/force_parts.hpp"
#include "undine/search/cell_grid.hpp"

namespace undine {
namespace {

using namespace field;

/// The value that a share of the values does not exceed; but for few values, all except the largest.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto last = values.size() - 1;
  auto at = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  at = std::min(at, share > 0.5 && last > 0 ? last - 1 : last);
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(at));
  return values[at];
}

/// r/spacing at which |grad W| is largest.
template <int N>
double gradient_peak(const KernelChoice& kernel, double support_over_spacing) {
  constexpr int samples = 200;
  double largest = -1, place = 0;
  for (int k = 0; k < samples; ++k) {
    const double R = static_cast<double>(k) / samples, slope = std::abs(kernel.template slope<N>(R));
    if (slope <= largest) continue;
    largest = slope;
    place = R;
  }
  return place * support_over_spacing;
}

/// What the walls' own `layers` lack to the support.
int layers_missing(const std::map<std::string, std::string>& resolved, int needed) {
  int missing = 0;
  for (int k = 0;; ++k) {
    const std::string wall = fmt::format("wall[{}].", k);
    const auto layers = resolved.find(wall + "layers");
    const auto sheet = resolved.find(wall + "sheet");
    if (layers == resolved.end() && sheet == resolved.end()) return missing;
    if (sheet != resolved.end() && sheet->second == "true")
      missing = std::max(missing, needed - 1);
    else if (layers != resolved.end())
      missing = std::max(missing, needed - std::atoi(layers->second.c_str()));
  }
}

/// Pairs and sums of the start. Distances in spacings: of a gas in those of its own, as in a PairSurvey.
template <int N>
void collect_filling(Evidence::Start& start, const CaseSetup<N>& setup) {
  const Store<N>& store = setup.store;
  const bool gas = setup.choice.is_gas;
  const auto at = store.template get<x>();
  const auto mass = store.template get<m>();
  const auto density = store.template get<rho>();
  const auto own_support = store.template get<h>();
  const KernelChoice kernel = setup.options().kernels[static_cast<std::size_t>(KernelRole::density)];
  const auto room = [&](std::size_t i) { return gas ? std::pow(mass[i] / density[i], 1.0 / N) : setup.spacing; };
  const IndexRange fluid = store.range(Group::fluid);
  double widest = setup.options().support.uniform;
  for (std::size_t i = fluid.begin; gas && i < fluid.end; ++i) widest = std::max(widest, own_support[i]);
  CellGrid<N> grid;
  grid.build(at, widest, setup.domain);
  std::vector<std::uint32_t> found;
  std::vector<double> filling, neighbours;
  double closest = widest / setup.spacing;
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const double H = gas ? own_support[i] : setup.options().support.uniform;
    grid.find(at[i], H, found);
    double sum = 0;
    for (const std::uint32_t j : found) {
      if (j >= fluid.end) continue;  // a sheet of wall particles lies closer by intention
      const double r = norm(setup.domain.nearest_image(at[i] - at[j]));
      sum += mass[j] * kernel.template w<N>(r / H) / std::pow(H, N);
      if (j != i) closest = std::min(closest, r / std::min(room(i), room(j)));
    }
    filling.push_back(sum / density[i]);
    neighbours.push_back(static_cast<double>(found.size()) - 1);
  }
  start.closest = closest;
  start.most_filling = filling.empty() ? 1 : *std::ranges::max_element(filling);
  start.filling = quantile(filling, 0.5);
  start.neighbours = quantile(neighbours, 0.5);
}

void collect_pairs(Evidence& e, const PairSurvey& pairs, std::size_t particles) {
  const auto share = [](std::size_t part, std::size_t all) {
    return static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
  };
  e.before.closest = pairs.closest;
  e.before.clumped = share(pairs.clumped, particles);
  e.before.isolated = share(pairs.isolated, particles);
  e.before.tension = share(pairs.tense, pairs.clumped);
  // Whoever is alone stands for all who are.
  if (e.alarm == Alarm::isolated && e.particle.id < 0) e.particle.id = pairs.lone;
}

/// What a particle asks of the step, 1/s.
template <int N>
class StepDemand {
 public:
  StepDemand(const Flow<N>& flow, const Evidence& e)
      : sound_(flow.store().template get<c>()),
        approach_(flow.store().template get<mu_cfl>()),
        signal_(flow.store().template get<v_signal>()),
        support_(flow.store().template get<h>()),
        acc_(flow.store().template get<acc>()),
        h_(e.h()),
        kappa_(e.setup.kappa),
        gas_(e.setup.gas) {}

  double signal_rate(std::size_t i) const { return signal_.empty() ? 0 : std::max(signal_[i], sound_[i]) / h_of(i); }
  double operator()(std::size_t i) const {
    const double sound = gas_ ? signal_rate(i) : (sound_[i] + (approach_.empty() ? 0 : approach_[i])) / h_;
    const double demand = std::max(sound / 0.4, std::sqrt(norm(acc_[i]) / h_of(i)) / 0.25);
    return std::isfinite(demand) ? demand : std::numeric_limits<double>::max();
  }

 private:
  double h_of(std::size_t i) const { return gas_ ? support_[i] / kappa_ : h_; }

  std::span<const double> sound_, approach_, signal_, support_;
  std::span<const Vec<N>> acc_;
  double h_, kappa_;
  bool gas_;
};

template <int N>
std::size_t index_of(const Store<N>& store, std::int64_t id) {
  return static_cast<std::size_t>(std::ranges::find(store.ids(), id) - store.ids().begin());
}

/// See Evidence::Exit::company.
template <int N>
double company_of(const Store<N>& store, const GasOptions<N>& gas, std::size_t i) {
  using terms::GradHDensities;
  const IndexRange fluid = store.range(Group::fluid);
  if (gas.grad_h.index() == GradHDensities::index<terms::DensityGradH>()) return static_cast<double>(fluid.size());
  const auto mass = store.template get<m>();
  return total_over(store, Group::fluid, [&](std::size_t b) { return mass[b]; }) / mass[i];
}

}  // namespace

template <int N>
void collect_case(Evidence& e, const CaseSetup<N>& setup, const std::map<std::string, std::string>& resolved) {
  const auto& options = setup.options();
  const Store<N>& store = setup.store;
  const IndexRange fluid = store.range(Group::fluid);
  auto& c = e.setup;
  c.dimensions = N;
  c.spacing = setup.spacing;
  c.support = options.support.uniform;
  c.kappa = options.support.kappa;
  c.gravity = norm(options.gravity);
  c.sound_speed = std::numeric_limits<double>::infinity();
  c.stiff = true;
  for (const auto& material : options.materials) {
    c.sound_speed = std::min(c.sound_speed, material.sound_speed(material.rho_0));
    c.stiff = c.stiff && is_stiff(material);
  }
  c.gradient_peak =
      gradient_peak<N>(options.kernels[static_cast<std::size_t>(KernelRole::pressure)], c.support / c.spacing);
  if (const auto* gas = std::get_if<GasOptions<N>>(&setup.scheme)) {
    c.gas = true;
    c.stiff = false;
    c.summed = gas->density != DensityForm::evolved;
    c.damped = gas->artificial || gas->stress;
    c.follows = gas->smoothing != SmoothingLaw::constant;
    using terms::EnergyForms;
    c.shares_work = gas->energy.index() == EnergyForms::index<terms::EnergySymmetric>() ||
                    gas->energy.index() == EnergyForms::index<terms::EnergySum>();
    if (gas->stress)
      for (const auto& material : options.materials) c.viscosity = std::max(c.viscosity, material.mu / material.rho_0);
    c.sound_speed = 0;  // of the gas as it is
    const KernelChoice& kernel = options.kernels[static_cast<std::size_t>(KernelRole::density)];
    if (gas->iterates()) c.least_company = std::pow(gas->support_over_spacing, N) / kernel.template w<N>(0.0);
  }
  c.removes = options.lets_escape;
  c.ghosts = setup.choice.ghosts.has_value();
  if (c.ghosts) c.room = std::max(options.mirrored_support, options.support.uniform);
  for (int k = 0; k < N; ++k)
    if (setup.domain.periodic[k])
      c.room = std::min(c.room, setup.domain.length(k) / (2 * (1 + options.neighbours.skin)));
  if (const auto* liquid = std::get_if<WeaklyCompressibleOptions<N>>(&setup.scheme)) {
    c.summed = liquid->density != DensityForm::evolved;
    c.damped = liquid->artificial || liquid->viscosity;
    if (liquid->viscosity)
      for (const auto& material : options.materials) c.viscosity = std::max(c.viscosity, material.mu / material.rho_0);
  }
  c.fixed_step = setup.choice.limits.fixed > 0;
  c.euler = setup.choice.integrator == integrators::Euler::info.name;
  c.walls = setup.walls && !setup.walls->empty();
  c.guarded = setup.choice.reflects && std::ranges::none_of(resolved, [](const auto& line) {
                return line.first.starts_with("wall[") && line.first.ends_with(".reflects") && line.second == "false";
              });
  if (setup.choice.wall_particles)
    c.layers_missing = layers_missing(resolved, static_cast<int>(std::ceil(c.support / c.spacing - 1e-9)));

  auto& s = e.start;
  s.least_mass = s.lowest_density = std::numeric_limits<double>::infinity();
  s.most_mass = s.highest_density = 0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  std::vector<double> speeds;
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const auto& material = options.materials[static_cast<std::size_t>(store.materials()[i])];
    const double level = -dot(options.gravity, store.template get<x>()[i]);
    lowest = std::min(lowest, level);
    highest = std::max(highest, level);
    const double share = store.template get<m>()[i] / (material.rho_0 * std::pow(setup.spacing, N));
    s.least_mass = std::min(s.least_mass, share);
    s.most_mass = std::max(s.most_mass, share);
    const double density = store.template get<rho>()[i] / material.rho_0;
    s.lowest_density = std::min(s.lowest_density, density);
    s.highest_density = std::max(s.highest_density, density);
    speeds.push_back(norm(store.template get<v>()[i]));
    if (c.gas)
      s.sound =
          std::max(s.sound, material.sound_speed(store.template get<rho>()[i], store.template get<field::e>()[i]));
    if (material.pressure(store.template get<rho>()[i]) < 0) s.tension += 1.0 / static_cast<double>(fluid.size());
  }
  c.depth = c.gravity > 0 && highest > lowest ? (highest - lowest) / c.gravity : 0;
  c.sound_speed = std::max(c.sound_speed, s.sound);
  s.fastest = speeds.empty() ? 0 : *std::ranges::max_element(speeds);
  s.typical_speed = quantile(speeds, 0.99);
  collect_filling(s, setup);
}

template <int N>
void collect_state(Evidence& e, const Flow<N>& flow, const CaseSetup<N>& setup, Rates rates) {
  const Store<N>& store = flow.store();
  const auto at = store.template get<x>();
  const auto u = store.template get<v>();
  const auto a = store.template get<acc>();
  const IndexRange fluid = store.range(Group::fluid), wall = store.range(Group::wall);
  const bool has_walls = setup.walls && !setup.walls->empty();
  const bool listed = flow.neighbours().support() > 0;  // not where the very first look at the state ended it
  auto& b = e.before;
  if (listed) collect_pairs(e, survey_pairs(flow, setup.spacing), fluid.size());
  std::vector<double> demands;
  const StepDemand<N> demand(flow, e);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    b.fastest = std::max(b.fastest, norm(u[i]));
    if (has_walls) b.behind = std::max(b.behind, -setup.walls->depth(widen(at[i])));
    demands.push_back(demand(i));
    if (e.setup.gas) {
      e.setup.sound_speed = std::max(e.setup.sound_speed, store.template get<c>()[i]);
      b.courant = std::max(b.courant, demand.signal_rate(i) * e.dt);
    }
    if (!flow.options().body_force) continue;
    for (const double t : {e.time, e.time + 0.5 * e.dt, e.time + e.dt}) {
      const double strength = norm(flow.options().body_force(at[i], t));
      if (!std::isfinite(strength))
        b.body_force_finite = false;
      else
        b.body_force = std::max(b.body_force, strength);
    }
  }
  if (!demands.empty()) b.one_against_rest = *std::ranges::max_element(demands) / quantile(demands, 0.99);
  for (std::size_t i = wall.begin; i < wall.end; ++i) b.fastest_wall = std::max(b.fastest_wall, norm(u[i]));

  if (e.particle.id < 0 && e.alarm == Alarm::step_collapse && !demands.empty())
    e.particle.id =
        store.ids()[fluid.begin + static_cast<std::size_t>(std::ranges::max_element(demands) - demands.begin())];
  const std::size_t i = index_of(store, e.particle.id);
  if (i >= fluid.end) return;
  auto& p = e.particle;
  const auto& material = flow.options().materials[static_cast<std::size_t>(store.materials()[i])];
  p.x = widen(at[i]);
  p.v = widen(u[i]);
  p.acc = widen(a[i]);
  p.rho = store.template get<rho>()[i];
  p.rho_0 = material.rho_0;
  p.p = store.template get<field::p>()[i];
  p.c = store.template get<c>()[i];
  if (has_walls && !e.exit.left) p.depth = setup.walls->depth(p.x);
  if (e.setup.gas) {
    p.e = store.template get<field::e>()[i];
    p.support = store.template get<h>()[i];
  }
  if (listed && rates == Rates::known)
    for (const auto& part : force_parts(flow, i)) p.forces.push_back({part.term, norm(part.acc)});
  const auto size = [](const ForceShare& share) {  // what is no number leads
    return std::isnan(share.size) ? std::numeric_limits<double>::infinity() : share.size;
  };
  std::ranges::stable_sort(p.forces, std::ranges::greater{}, size);
}

template <int N>
void collect_exit(Evidence& e, const Flow<N>& flow, const CaseSetup<N>& setup) {
  const Store<N>& store = flow.store();
  for (const double H : store.template get<h>()) e.exit.widest = std::max(e.exit.widest, H);
  const std::size_t i = index_of(store, e.particle.id);
  if (i >= store.size()) return;
  if (const auto* gas = std::get_if<GasOptions<N>>(&setup.scheme)) e.exit.company = company_of(store, *gas, i);
  if (e.alarm != Alarm::outside) return;
  const Vec<N> at = store.template get<x>()[i];
  e.exit.left = true;
  e.exit.speed = norm(store.template get<v>()[i]);
  double farthest = 0;
  for (int k = 0; k < N; ++k) {
    if (flow.domain().periodic[k]) continue;
    const double below = flow.domain().low[k] - at[k], above = at[k] - flow.domain().high[k];
    if (std::max(below, above) <= farthest) continue;
    farthest = std::max(below, above);
    const double pull = (below > above ? -1 : 1) * flow.options().gravity[k];  // along the way out
    e.exit.downwards = pull > 0.5 * norm(flow.options().gravity);
    e.exit.upwards = pull < -0.5 * norm(flow.options().gravity);
  }
  if (setup.walls && !setup.walls->empty()) e.particle.depth = setup.walls->depth(widen(at));
}

template <int N>
std::int64_t first_not_finite(const Flow<N>& bad, const Flow<N>& before) {
  const Store<N>& now = bad.store();
  const IndexRange fluid = now.range(Group::fluid);
  std::set<std::int64_t> ids;
  for (std::size_t i = fluid.begin; i < fluid.end; ++i)
    if (!std::isfinite(norm_sq(now.template get<x>()[i]) + norm_sq(now.template get<v>()[i]) +
                       now.template get<rho>()[i] + norm_sq(now.template get<acc>()[i])))
      ids.insert(now.ids()[i]);
  std::int64_t first = -1;
  double most = -1;
  const Store<N>& then = before.store();
  for (std::size_t i = then.range(Group::fluid).begin; i < then.range(Group::fluid).end; ++i) {
    if (!ids.contains(then.ids()[i])) continue;
    const double strength = norm_sq(then.template get<acc>()[i]);
    if (strength <= most) continue;
    most = strength;
    first = then.ids()[i];
  }
  return first;
}

template void collect_case(Evidence&, const CaseSetup<1>&, const std::map<std::string, std::string>&);
template void collect_case(Evidence&, const CaseSetup<2>&, const std::map<std::string, std::string>&);
template void collect_case(Evidence&, const CaseSetup<3>&, const std::map<std::string, std::string>&);
template void collect_state(Evidence&, const Flow<1>&, const CaseSetup<1>&, Rates);
template void collect_state(Evidence&, const Flow<2>&, const CaseSetup<2>&, Rates);
template void collect_state(Evidence&, const Flow<3>&, const CaseSetup<3>&, Rates);
template void collect_exit(Evidence&, const Flow<1>&, const CaseSetup<1>&);
template void collect_exit(Evidence&, const Flow<2>&, const CaseSetup<2>&);
template void collect_exit(Evidence&, const Flow<3>&, const CaseSetup<3>&);
template std::int64_t first_not_finite(const Flow<1>&, const Flow<1>&);
template std::int64_t first_not_finite(const Flow<2>&, const Flow<2>&);
template std::int64_t first_not_finite(const Flow<3>&, const Flow<3>&);

}  // namespace undine
