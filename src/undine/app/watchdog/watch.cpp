#include "undine/app/watchdog/watch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>

#include "undine/app/watchdog/pair_survey.hpp"
#include "undine/engine/update.hpp"
#include "undine/schemes/gas.hpp"
#include "undine/schemes/state_error.hpp"

namespace undine {
namespace {

using namespace field;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int N>
bool is_finite(const Store<N>& store, std::size_t i) {
  const auto energy = store.template get<e>();
  return std::isfinite(norm_sq(store.template get<x>()[i]) + norm_sq(store.template get<v>()[i]) +
                       store.template get<rho>()[i] + (energy.empty() ? 0.0 : energy[i]));
}

/// Index of the first particle of fluid that the test finds; the store's size where it finds none.
template <int N, class Test>
std::size_t find_fluid(const Store<N>& store, Test&& test) {
  const IndexRange fluid = store.range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i)
    if (test(i)) return i;
  return store.size();
}

}  // namespace

bool is_stiff(const materials::Material& material) {
  return std::visit(
      []<class Law>(const Law&) {
        return std::is_same_v<Law, materials::TaitSoundSpeed> || std::is_same_v<Law, materials::Tait> ||
               std::is_same_v<Law, materials::Linear>;
      },
      material.eos);
}

template <int N>
Watch<N>::Watch(const WatchLimits& limits, const Subject& subject, const std::vector<materials::Material>& materials)
    : limits_(limits), subject_(subject) {
  for (const auto& material : materials) {
    const bool stiff = is_stiff(material);
    rest_.push_back(material.rho_0);
    lowest_.push_back(stiff && !subject.summed ? material.rho_0 * (1 - limits.density) : -infinity);
    highest_.push_back(stiff ? material.rho_0 * (1 + limits.density) : infinity);
  }
}

template <int N>
void Watch<N>::quickly(const Flow<N>& flow) const {
  if (!limits_.active) return;
  const Store<N>& store = flow.store();
  const auto density = store.template get<rho>();
  const auto material = store.materials();
  if (total_over(store, Group::fluid, [&](std::size_t i) { return within(density[i], material[i]) ? 0 : 1; }) == 0)
    return;
  const IndexRange fluid = store.range(Group::fluid);
  std::size_t worst = fluid.begin;
  double most = -1;
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const double off = std::abs(density[i] / rest_[static_cast<std::size_t>(material[i])] - 1);
    if (within(density[i], material[i]) || !(off > most || std::isnan(off))) continue;
    worst = i;
    most = std::isnan(off) ? infinity : off;
  }
  throw AlarmError({std::isfinite(density[worst]) ? Alarm::density : Alarm::not_finite, store.ids()[worst]},
                   {.what = fmt::format("particle {} has a density of {:.6g} kg/m^3 at t = {:.6g} s",
                                        store.ids()[worst], density[worst], flow.time()),
                    .why = fmt::format("a stiff liquid keeps within {:.3g} of rho_0 = {:.6g} kg/m^3", limits_.density,
                                       rest_[static_cast<std::size_t>(material[worst])])});
}

template <int N>
void Watch<N>::step(const Flow<N>& flow, const Step& next) const {
  if (std::isfinite(next.dt) && next.dt > 0 &&
      (!limits_.active || next.dt > limits_.smallest_step * subject_.largest_step))
    return;
  throw AlarmError({Alarm::step_collapse, -1},
                   {.what = fmt::format("the time step collapsed to {:.3g} s at t = {:.6g} s", next.dt, flow.time()),
                    .why = fmt::format("it is limited by '{}'; {} {:.3g} s are possible", next.limiter,
                                       subject_.courant_h > 0 ? "with its energy evenly spread" : "at rest",
                                       subject_.largest_step)});
}

template <int N>
void Watch<N>::fully(const Flow<N>& flow) {
  if (!limits_.active) return;
  check_places(flow);
  check_energies(flow);
  quickly(flow);
  check_pairs(flow);
  audit(flow);
}

template <int N>
void Watch<N>::check_places(const Flow<N>& flow) const {
  const Store<N>& store = flow.store();
  const auto at = store.template get<x>();
  const bool may_leave = flow.options().lets_escape;
  const auto good = [&](std::size_t i) { return is_finite(store, i) && (may_leave || flow.domain().contains(at[i])); };
  if (total_over(store, Group::fluid, [&](std::size_t i) { return good(i) ? 0 : 1; }) == 0) return;
  const std::size_t i = find_fluid(store, [&](std::size_t k) { return !good(k); });
  const bool finite = is_finite(store, i);
  throw AlarmError({finite ? Alarm::outside : Alarm::not_finite, store.ids()[i]},
                   {.what = fmt::format("particle {} {} at t = {:.6g} s", store.ids()[i],
                                        finite ? "left the domain" : "is no longer finite", flow.time())});
}

/// A gas has no internal energy below zero, and takes room.
template <int N>
void Watch<N>::check_energies(const Flow<N>& flow) const {
  if (!dynamic_cast<const Gas<N>*>(&flow)) return;
  const Store<N>& store = flow.store();
  const auto energy = store.template get<e>(), density = store.template get<rho>();
  const auto good = [&](std::size_t i) { return energy[i] >= 0 && density[i] > 0; };
  if (total_over(store, Group::fluid, [&](std::size_t i) { return good(i) ? 0 : 1; }) == 0) return;
  const std::size_t i = find_fluid(store, [&](std::size_t k) { return !good(k); });
  throw AlarmError({Alarm::energy, store.ids()[i]},
                   {.what = fmt::format("particle {} has e = {:.4g} J/kg and rho = {:.4g} kg/m^3 at t = {:.6g} s",
                                        store.ids()[i], energy[i], density[i], flow.time())});
}

template <int N>
void Watch<N>::check_pairs(const Flow<N>& flow) const {
  const bool gas = dynamic_cast<const Gas<N>*>(&flow);
  // What may be compressed as it likes, by a pressure that knows no room of its own, comes as near as it likes.
  if (!gas && std::ranges::none_of(highest_, [](double bound) { return std::isfinite(bound); })) return;
  const PairSurvey survey = survey_pairs(flow, subject_.spacing, limits_.closest);
  const auto count = static_cast<double>(std::max<std::size_t>(flow.store().range(Group::fluid).size(), 1));
  const auto share = [&](std::size_t particles) { return static_cast<double>(particles) / count; };
  const auto stop = [&](std::size_t particles, const char* what, double distance) {
    throw AlarmError(
        {Alarm::coincidence, survey.particle},
        {.what = fmt::format("{} particles {} at t = {:.6g} s", particles, what, flow.time()),
         .why = fmt::format(
             "that is {:.2g} % of all, nearer than {} spacings to another one; the closest two are {:.3g} m "
             "apart",
             100 * share(particles), distance, survey.distance)});
  };
  // In 1-D particles cannot pass each other. A sum lets those at surfaces clump, which a run may live with; a gas has
  // none, and where it clumps its streams pass through each other.
  if (share(survey.coincident) > (N == 1 ? 0 : limits_.coincident))
    stop(survey.coincident, "coincide", limits_.closest);
  if ((gas || !subject_.summed) && share(survey.clumped) > limits_.clumped)
    stop(survey.clumped, "have clumped", clump_distance);
  if (gas && share(survey.isolated) > limits_.isolated)
    throw AlarmError(
        {Alarm::isolated, -1},
        {.what = fmt::format("{} particles have no neighbour at t = {:.6g} s", survey.isolated, flow.time()),
         .why =
             fmt::format("that is {:.2g} % of the gas; they fly on without pressure", 100 * share(survey.isolated))});
}

template <int N>
void Watch<N>::audit(const Flow<N>& flow) {
  if (!limits_.active || !subject_.audited) return;
  const Energies e = flow.energies();
  const double total = e.total(), jump = std::abs(total - total_), allowed = limits_.residual * scale_;
  const double size = std::abs(e.kinetic) + std::abs(e.potential) + std::abs(e.elastic);
  const bool first = std::isnan(total_);
  if (!first && scale_ > 0 && !(jump <= allowed))
    throw AlarmError(
        {Alarm::residual, -1},
        {.what = fmt::format("the residual of the energy audit jumped by {:.3g} J at t = {:.6g} s", jump, flow.time()),
         .why = fmt::format("the largest energy so far is {:.4g} J", scale_)});
  total_ = total;
  scale_ = std::max(scale_, size);
  if (subject_.courant_h > 0 && scale_ > 0) {
    const auto masses = flow.store().template get<m>();
    const double mass = total_over(flow.store(), Group::fluid, [&](std::size_t i) { return masses[i]; });
    subject_.largest_step = subject_.courant_h / std::sqrt(2 * scale_ / mass);
  }
}

template <int N>
std::optional<AlarmHit> hit_of(const RunError& error, const Flow<N>& flow) {
  if (const auto* state = dynamic_cast<const StateError*>(&error)) {
    constexpr std::array alarms{Alarm::not_finite, Alarm::outside, Alarm::energy, Alarm::support};  // as in Trouble
    return AlarmHit{alarms[static_cast<std::size_t>(state->trouble())], state->particle()};
  }
  const Store<N>& store = flow.store();
  const auto a = store.template get<acc>();
  const auto bad = [&](std::size_t i) { return !is_finite(store, i) || !std::isfinite(norm_sq(a[i])); };
  if (const std::size_t i = find_fluid(store, bad); i < store.size())
    return AlarmHit{Alarm::not_finite, store.ids()[i]};
  const auto out = [&](std::size_t i) { return !flow.domain().contains(store.template get<x>()[i]); };
  if (const std::size_t i = find_fluid(store, out); i < store.size()) return AlarmHit{Alarm::outside, store.ids()[i]};
  return {};
}

template std::optional<AlarmHit> hit_of(const RunError&, const Flow<1>&);
template std::optional<AlarmHit> hit_of(const RunError&, const Flow<2>&);
template std::optional<AlarmHit> hit_of(const RunError&, const Flow<3>&);
template class Watch<1>;
template class Watch<2>;
template class Watch<3>;

}  // namespace undine
