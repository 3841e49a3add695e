#pragma once
// What the readers of schemes share: case_scheme.cpp (liquids) and case_gas.cpp.
#include <string>
#include <string_view>
#include <vector>

#include "undine/app/case_scheme.hpp"
#include "undine/app/parameters.hpp"
#include "undine/schemes/presets.hpp"

namespace undine {

/// The word chosen for `form`, out of the names of a list and further words.
template <class List>
std::string read_form(const Table& table, std::string_view fallback, std::vector<std::string> more = {}) {
  auto names = List::names();
  names.insert(names.end(), more.begin(), more.end());
  return table.choice("form", names, std::string(fallback));
}

/// A choice out of a list of terms with its parameters, or nothing for "none".
template <class List>
std::optional<OneOf<List>> read_optional(const Table& table, std::string_view fallback, OneOf<List> choice = {}) {
  const std::string form = read_form<List>(table, fallback, {"none"});
  if (form == "none") return {};
  choice.choose(List::index_of(form));
  choice.with_chosen([&](auto& term) { read_parameters(table, term); });
  return choice;
}

/// The density form of a word: a sum, or else evolved by the continuity form of that name.
inline DensityForm density_form(std::string_view word) {
  return word == "summation"              ? DensityForm::summation
         : word == "normalised_summation" ? DensityForm::normalised
                                          : DensityForm::evolved;
}

/// Whether, and how, a density that is carried by continuity is summed anew now and then.
template <int N>
void read_density_filter(const Table& scheme, bool carried, FlowOptions<N>& options) {
  const Table table = scheme.table("density_filter");
  const std::string form = read_form<terms::DensityFilters>(table, "none", {"none"});
  if (form == "none") return;
  if (!carried)
    table.fail("form", "only a density that is carried by continuity can be summed anew",
               "another one is summed in every step as it is",
               "set scheme.density.form = \"continuity\", or leave the filter out");
  ChoiceOf<terms::DensityFilters> filter;
  filter.choose(terms::DensityFilters::index_of(form));
  filter.with_chosen([&](auto& chosen) { read_parameters(table, chosen); });
  options.density_filter = filter;
}

/// What a preset says of the keys that all schemes have.
struct PresetBasics {
  std::string_view kernel, wall, wall_reference, integrator;
  double support_over_spacing, fixed_step;
  bool wall_pulls, guard;
  int wall_layers;
};
template <class Preset>
constexpr PresetBasics basics_of() {
  return {
      Preset::kernel,     Preset::wall,       Preset::wall_reference, Preset::integrator, Preset::support_over_spacing,
      Preset::fixed_step, Preset::wall_pulls, Preset::guard,          Preset::wall_layers};
}

/// The words of [scheme.smoothing] that a scheme knows, in the order of the enumerations, and its own law.
struct SmoothingWords {
  std::vector<std::string> laws, means;
  std::string_view law;
};

/// Kernels, support and backend.
template <int N>
void read_basics(const Table& scheme, double spacing, const PresetBasics& preset, const SmoothingWords& words,
                 FlowOptions<N>& options);
/// The treatment of walls.
template <int N>
void read_walls(const Table& scheme, const PresetBasics& preset, FlowOptions<N>& options, SchemeChoice& choice);
/// Integrator and steps.
void read_time(const Table& root, const PresetBasics& preset, SchemeChoice& choice);

/// A gas by its preset.
template <int N, class Preset>
SchemeChoice read_gas(const Table& root, double spacing, GasOptions<N>& options, Preset preset);

}  // namespace undine
