#include "undine/app/lists.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "undine/analysis/exact/catalogue.hpp"
#include "undine/app/gauges.hpp"
#include "undine/app/watchdog/causes/catalogue.hpp"
#include "undine/approximation/catalogue.hpp"
#include "undine/backend/backend.hpp"
#include "undine/core/error.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/nearest.hpp"
#include "undine/core/parameter.hpp"
#include "undine/integrators/catalogue.hpp"
#include "undine/kernels/catalogue.hpp"
#include "undine/materials/catalogue.hpp"
#include "undine/schemes/presets.hpp"
#include "undine/search/search.hpp"
#include "undine/terms/catalogue.hpp"
#include "undine/terms/density/filters.hpp"
#include "undine/terms/velocity/shifting.hpp"
#include "undine/walls/catalogue.hpp"

namespace undine {
namespace {

/// A density that is made of two sums.
struct NormalisedSummation {
  static constexpr Info info{"normalised_summation", "Density summed, over the Shepard sum of the same neighbours",
                             "rho_a = sum_b m_b W_ab / sum_b (m_b/rho_b) W_ab, rho_b the plain sum of b",
                             "Shepard (1968); Niedoba (2012), eq. 2.58"};
  using reads = Union<terms::Summation::reads, terms::ShepardSum::reads>;
  using adds = Union<terms::Summation::adds, terms::ShepardSum::adds>;
};
using SummedDensities = Catalogue<terms::Summation, NormalisedSummation>;

// In the order of their names in backend.hpp.
constexpr std::array<std::string_view, backend_names.size()> backend_titles{
    "All cores of this machine, with SIMD", "One core, one pair at a time: the reference",
    "As `serial`; finds a term that reads what nothing wrote"};
constexpr std::array<std::string_view, precision_names.size()> precision_titles{
    "State in double, pairs in float on relative positions", "State and pairs in double"};

// In the order of the enumerators.
constexpr std::string_view wall_density_words[]{"none",
                                                "by continuity",
                                                "from the fluid's sum",
                                                "from the fluid's pressure",
                                                "from the fluid mirrored",
                                                "that of the parent"};
constexpr std::string_view rank_words[]{"scalar", "vector", "tensor"};
constexpr std::string_view role_words[]{"constant", "state", "rate", "derived"};
constexpr std::string_view join_words[]{"sum", "max"};

template <class Enum, std::size_t size>
std::string word(Enum value, const std::string_view (&words)[size]) {
  const auto index = static_cast<std::size_t>(value);
  return index < size ? std::string(words[index]) : std::to_string(index);
}

Entry entry_of(const Info& info) {
  return {std::string(info.name), std::string(info.title), std::string(info.equation), std::string(info.citation)};
}

Entry entry_of(const FieldInfo& field) {
  Entry entry{std::string(field.name), std::string(field.meaning)};
  entry.properties = {{"unit", std::string(field.unit)},
                      {"rank", word(field.rank, rank_words)},
                      {"role", word(field.role, role_words)},
                      {"join", word(field.join, join_words)}};
  return entry;
}

template <class FieldList>
std::vector<std::string> field_names() {
  std::vector<std::string> names;
  FieldList::for_each([&]<class F>(F) { names.emplace_back(F::info.name); });
  return names;
}

/// What the entry's struct declares: whatever of these members it has.
template <class T>
Entry entry_of_type() {
  Entry entry = entry_of(T::info);
  for_each_parameter<T>([&](const auto& parameter) {
    entry.parameters.push_back({std::string(parameter.name), T{}.*parameter.member, std::string(parameter.unit),
                                std::string(parameter.meaning), parameter.low, parameter.high});
  });
  if constexpr (requires { typename T::reads; }) entry.reads = field_names<typename T::reads>();
  if constexpr (requires { typename T::adds; }) entry.adds = field_names<typename T::adds>();
  if constexpr (requires { T::natural_kappa; })
    entry.properties = {{"kappa", fmt::format("{}", T::natural_kappa)},
                        {"smoothness", T::smoothness < 0 ? "jumps" : fmt::format("C{}", T::smoothness)},
                        {"positive", T::positive ? "yes" : "no"}};
  if constexpr (requires { T::coordinates; }) {
    std::string point = "t", values;
    for (const auto& coordinate : T::coordinates) point += fmt::format(", {}", coordinate);
    for (const auto& field : T::fields) values += fmt::format("{}{}", values.empty() ? "" : ", ", field.name);
    entry.properties = {{"of", point}, {"fields", values}};
  }
  if constexpr (requires { T::reflects; })
    entry.properties = {{"density", word(T::density, wall_density_words)}, {"reflects", T::reflects ? "yes" : "no"}};
  if constexpr (requires { T::lowest_order; })
    entry.properties = {
        {"orders", T::lowest_order == T::highest_order ? fmt::format("{}", T::lowest_order)
                                                       : fmt::format("{} to {}", T::lowest_order, T::highest_order)},
        {"volumes", T::needs_volumes ? "yes" : "no"}};
  return entry;
}

template <class... Lists>
Axis axis_of(std::string name, std::string title) {
  Axis axis{std::move(name), std::move(title), {}};
  (Lists::for_each([&]<class T>(T) { axis.entries.push_back(entry_of_type<T>()); }), ...);
  return axis;
}

Axis axis_of_infos(std::string name, std::string title, const auto& infos) {
  Axis axis{std::move(name), std::move(title), {}};
  for (const auto& info : infos) axis.entries.push_back(entry_of(info));
  return axis;
}

Axis axis_of_words(std::string name, std::string title, const auto& words, const auto& titles) {
  Axis axis{std::move(name), std::move(title), {}};
  for (std::size_t k = 0; k < words.size(); ++k)
    axis.entries.push_back({std::string(words[k]), std::string(titles[k])});
  return axis;
}

std::vector<Axis> make_axes() {
  return {
      axis_of<presets::Presets>("schemes", "Schemes: what the keys of [scheme] default to"),
      axis_of<Kernels>("kernels", "Smoothing kernels"),
      axis_of<terms::ContinuityForms, SummedDensities>("density", "Where the density comes from"),
      axis_of<terms::PressureForms>("pressure", "Forms of the pressure force"),
      axis_of<terms::ViscosityForms>("viscosity", "Forms of the viscous force"),
      axis_of<terms::ArtificialViscosities>("artificial_viscosity", "Artificial viscosities"),
      axis_of<terms::DiffusionForms>("density_diffusion", "Density diffusion"),
      axis_of<terms::DensityFilters>("density_filter", "How a density that is carried by continuity is summed anew"),
      axis_of<terms::VelocityCorrections>("velocity_correction", "Corrections of the velocity that moves particles"),
      axis_of<terms::Shiftings>("shifting", "How particles are shifted towards even spacing"),
      axis_of<terms::GradHDensities>("gas_density", "Densities of gases that determine the support radius, and by it"),
      axis_of<terms::GasPressureForms>("gas_pressure", "Forms of the pressure force of gases"),
      axis_of<terms::EnergyForms>("energy", "Work of pressure on the internal energy of gases"),
      axis_of<terms::GasViscosities>("gas_viscosity", "Artificial viscosities of gases, with their heat"),
      axis_of<terms::ViscositySwitches>("viscosity_switch", "Switches of the artificial viscosity of gases"),
      axis_of<terms::StressForms>("stress", "Forms of the viscous stress of gases, with its heat"),
      axis_of<terms::Conductivities>("conductivity", "Artificial conductivities of gases"),
      axis_of<terms::Sums>("sums", "Sums that densities are made of"),
      axis_of<terms::Measures>("measures", "What a run measures with: gradients, and the approach speed for the step"),
      axis_of<materials::EquationsOfState>("equations_of_state", "Equations of state"),
      axis_of<walls::Walls>("walls", "Wall treatments"),
      axis_of<terms::WallForces>("wall_forces", "Forces of wall particles apart from pressure"),
      axis_of<integrators::Integrators>("integrators", "Time integrators"),
      axis_of<approximation::Methods>("approximations", "Approximation from scattered points (`undine approximate`)"),
      axis_of_infos("searches", "Neighbour searches", search_infos()),
      axis_of_words("backends", "Who runs the loops", backend_names, backend_titles),
      axis_of_words("precisions", "Number types of the pair arithmetic", precision_names, precision_titles),
      axis_of_infos("gauges", "Instruments that record a run", gauge_infos()),
      axis_of<exact::ExactSolutions>("exact", "Exact solutions, for `undine exact` and the gauge `error`"),
      axis_of<causes::Causes>("causes", "Why runs go bad, in the order in which the watchdog asks"),
      axis_of_infos("fields", "Quantities of a particle", all_fields),
  };
}

template <class T>
std::vector<std::string> names_of(const std::vector<T>& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

/// What to say to a word that is none of `valid`.
std::string correction(std::string_view wrong, const std::vector<std::string>& valid) {
  const auto guess = did_you_mean(wrong, valid);
  return fmt::format("{}{}valid: {}", guess, guess.empty() ? "" : " ", listed(valid));
}

/// The entries of that name in one axis, or in all.
std::vector<Found> entries_named(std::string_view name, const Axis* only) {
  std::vector<Found> found;
  for (const Axis& axis : axes())
    for (const Entry& entry : axis.entries)
      if ((!only || only == &axis) && entry.name == name) found.push_back({&axis, &entry});
  return found;
}

}  // namespace

const std::vector<Axis>& axes() {
  static const std::vector<Axis> all = make_axes();
  return all;
}

const Axis& find_axis(std::string_view name) {
  for (const Axis& axis : axes())
    if (axis.name == name) return axis;
  throw InputError({.what = fmt::format("there is no list called '{}'", shortened(name, 60)),
                    .fix = correction(name, names_of(axes()))});
}

std::vector<Found> find_entries(std::string_view name) {
  const auto slash = name.find('/');
  const Axis* only = slash == std::string_view::npos ? nullptr : &find_axis(name.substr(0, slash));
  const std::string_view wanted = only ? name.substr(slash + 1) : name;
  auto found = entries_named(wanted, only);
  if (!found.empty()) return found;

  const auto quoted = shortened(wanted, 60);
  if (only)
    throw InputError({.what = fmt::format("there is no '{}' in {}", quoted, only->name),
                      .fix = correction(wanted, names_of(only->entries))});
  if (const auto all = names_of(axes()); std::find(all.begin(), all.end(), wanted) != all.end())
    throw InputError({.what = fmt::format("'{}' is a list, not an entry of one", quoted),
                      .fix = fmt::format("`undine list {}` prints it", quoted)});
  std::vector<std::string> valid;
  for (const Axis& axis : axes())
    for (const Entry& entry : axis.entries)
      if (std::find(valid.begin(), valid.end(), entry.name) == valid.end()) valid.push_back(entry.name);
  throw InputError({.what = fmt::format("nothing is called '{}'", quoted), .fix = correction(wanted, valid)});
}

}  // namespace undine
