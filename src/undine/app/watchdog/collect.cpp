#include "undine/app/watchdog/collect.hpp"

#include <algorithm>
#include <cmath>
#include <set>

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

/// Pairs and sums of the start.
template <int N>
void collect_filling(Evidence::Start& start, const CaseSetup<N>& setup) {
  const Store<N>& store = setup.store;
  const auto at = store.template get<x>();
  const auto mass = store.template get<m>();
  const auto density = store.template get<rho>();
  const double H = setup.options().support.uniform;
  const KernelChoice kernel = setup.options().kernels[static_cast<std::size_t>(KernelRole::density)];
  CellGrid<N> grid;
  grid.build(at, H, setup.domain);
  std::vector<std::uint32_t> found;
  std::vector<double> filling, neighbours;
  double closest = H;
  const IndexRange fluid = store.range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    grid.find(at[i], H, found);
    double sum = 0;
    for (const std::uint32_t j : found) {
      if (j >= fluid.end) continue;  // a sheet of wall particles lies closer by intention
      const double r = norm(setup.domain.nearest_image(at[i] - at[j]));
      sum += mass[j] * kernel.template w<N>(r / H) / std::pow(H, N);
      if (j != i) closest = std::min(closest, r);
    }
    filling.push_back(sum / density[i]);
    neighbours.push_back(static_cast<double>(found.size()) - 1);
  }
  start.closest = closest / setup.spacing;
  start.most_filling = filling.empty() ? 1 : *std::ranges::max_element(filling);
  start.filling = quantile(filling, 0.5);
  start.neighbours = quantile(neighbours, 0.5);
}

template <int N>
std::size_t index_of(const Store<N>& store, std::int64_t id) {
  return static_cast<std::size_t>(std::ranges::find(store.ids(), id) - store.ids().begin());
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
  if (setup.choice.is_gas) c.sound_speed = 1;  // of the gas as it is: collect_state
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
    if (material.pressure(store.template get<rho>()[i]) < 0) s.tension += 1.0 / static_cast<double>(fluid.size());
  }
  c.depth = c.gravity > 0 && highest > lowest ? (highest - lowest) / c.gravity : 0;
  s.fastest = speeds.empty() ? 0 : *std::ranges::max_element(speeds);
  s.typical_speed = quantile(speeds, 0.99);
  collect_filling(s, setup);
}

template <int N>
void collect_state(Evidence& e, const Flow<N>& flow, const CaseSetup<N>& setup) {
  const Store<N>& store = flow.store();
  const auto at = store.template get<x>();
  const auto u = store.template get<v>();
  const auto a = store.template get<acc>();
  const IndexRange fluid = store.range(Group::fluid), wall = store.range(Group::wall);
  const bool has_walls = setup.walls && !setup.walls->empty();
  const PairSurvey pairs = survey_pairs(flow, setup.spacing);
  auto& b = e.before;
  b.closest = pairs.closest / setup.spacing;
  b.clumped = static_cast<double>(pairs.clumped) / static_cast<double>(std::max<std::size_t>(fluid.size(), 1));
  b.tension = pairs.clumped ? static_cast<double>(pairs.tense) / static_cast<double>(pairs.clumped) : 0;
  if (setup.choice.is_gas)
    for (std::size_t i = fluid.begin; i < fluid.end; ++i)
      e.setup.sound_speed = std::max(e.setup.sound_speed, store.template get<c>()[i]);
  std::vector<double> demands;
  const auto approach = store.template get<mu_cfl>();
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    b.fastest = std::max(b.fastest, norm(u[i]));
    if (has_walls) b.behind = std::max(b.behind, -setup.walls->depth(widen(at[i])));
    demands.push_back(std::max((store.template get<c>()[i] + (approach.empty() ? 0 : approach[i])) / (0.4 * e.h()),
                               std::sqrt(norm(a[i]) / e.h()) / 0.25));
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
  if (const auto* liquid = dynamic_cast<const WeaklyCompressible<N>*>(&flow))
    for (const auto& part : force_parts(*liquid, i)) p.forces.push_back({part.term, norm(part.acc)});
  std::ranges::stable_sort(p.forces, std::ranges::greater{}, &ForceShare::size);
}

template <int N>
void collect_exit(Evidence& e, const Flow<N>& flow, const CaseSetup<N>& setup) {
  const Store<N>& store = flow.store();
  const std::size_t i = index_of(store, e.particle.id);
  if (e.alarm != Alarm::outside || i >= store.size()) return;
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
template void collect_state(Evidence&, const Flow<1>&, const CaseSetup<1>&);
template void collect_state(Evidence&, const Flow<2>&, const CaseSetup<2>&);
template void collect_state(Evidence&, const Flow<3>&, const CaseSetup<3>&);
template void collect_exit(Evidence&, const Flow<1>&, const CaseSetup<1>&);
template void collect_exit(Evidence&, const Flow<2>&, const CaseSetup<2>&);
template void collect_exit(Evidence&, const Flow<3>&, const CaseSetup<3>&);
template std::int64_t first_not_finite(const Flow<1>&, const Flow<1>&);
template std::int64_t first_not_finite(const Flow<2>&, const Flow<2>&);
template std::int64_t first_not_finite(const Flow<3>&, const Flow<3>&);

}  // namespace undine
