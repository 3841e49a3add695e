#include "undine/app/lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

using nlohmann::ordered_json;

// ---- From the lists to text
// ------------------------------------------------------------------------------------------

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

// ---- The axes
// --------------------------------------------------------------------------------------------------------

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

struct Found {
  const Axis* axis;
  const Entry* entry;
};

/// The entries of that name in one axis, or in all.
std::vector<Found> entries_named(std::string_view name, const Axis* only) {
  std::vector<Found> found;
  for (const Axis& axis : axes())
    for (const Entry& entry : axis.entries)
      if ((!only || only == &axis) && entry.name == name) found.push_back({&axis, &entry});
  return found;
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

// ---- Tables
// ----------------------------------------------------------------------------------------------------------

/// Columns of text under a header.
struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  /// Adds a column, unless all its cells are empty.
  void column(const std::string& title, const std::vector<std::string>& cells) {
    if (std::all_of(cells.begin(), cells.end(), [](const auto& cell) { return cell.empty(); })) return;
    header.push_back(title);
    rows.resize(cells.size());
    for (std::size_t k = 0; k < cells.size(); ++k) rows[k].push_back(cells[k]);
  }
};

/// One column, made from each entry by f.
template <class F>
void add_column(TextTable& table, const Axis& axis, const std::string& title, F&& f) {
  std::vector<std::string> cells;
  for (const Entry& entry : axis.entries) cells.push_back(f(entry));
  table.column(title, cells);
}

void add_properties(TextTable& table, const Axis& axis) {
  if (axis.entries.empty()) return;
  for (std::size_t k = 0; k < axis.entries.front().properties.size(); ++k)
    add_column(table, axis, axis.entries.front().properties[k].first,
               [k](const Entry& entry) { return entry.properties[k].second; });
}

std::string aligned(const TextTable& table) {
  std::vector<std::vector<std::string>> lines{table.header};
  lines.insert(lines.end(), table.rows.begin(), table.rows.end());
  std::string text;
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t k = 0; k < line.size(); ++k) {
      std::size_t width = 0;
      for (const auto& other : lines) width = std::max(width, other[k].size());
      row += fmt::format("{:{}}", line[k], k + 1 == line.size() ? 0 : width + 2);
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

/// A row of a markdown table.
std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const auto& cell : cells) {
    row += ' ';
    for (const char c : cell) row += c == '|' ? std::string("\\|") : std::string(1, c);
    row += " |";
  }
  return row + "\n";
}

/// Text as markdown code; empty stays empty.
std::string code(const std::string& text) {
  if (text.empty()) return text;
  return text.find('`') == std::string::npos ? "`" + text + "`" : "`` " + text + " ``";
}

/// "alpha = 0.02 m/s (>= 0)"
std::string setting(const ParameterLine& parameter) {
  const auto unit = parameter.unit == "1" ? std::string() : " " + parameter.unit;
  return fmt::format("{} = {}{} ({})", parameter.name, parameter.fallback, unit, parameter.range());
}

std::string markdown_table(const Axis& axis) {
  TextTable table;
  add_column(table, axis, "name", [](const Entry& entry) { return code(entry.name); });
  add_column(table, axis, "what it is", [](const Entry& entry) { return entry.title; });
  add_properties(table, axis);
  add_column(table, axis, "equation", [](const Entry& entry) { return code(entry.equation); });
  add_column(table, axis, "parameters", [](const Entry& entry) {
    std::string cell;
    for (const auto& p : entry.parameters) cell += (cell.empty() ? "" : "<br>") + code(setting(p)) + " " + p.meaning;
    return cell;
  });
  add_column(table, axis, "reads", [](const Entry& entry) { return listed(entry.reads); });
  add_column(table, axis, "adds", [](const Entry& entry) { return listed(entry.adds); });
  add_column(table, axis, "source", [](const Entry& entry) { return entry.citation; });
  std::string text = markdown_row(table.header) + "|";
  for (std::size_t k = 0; k < table.header.size(); ++k) text += "---|";
  text += "\n";
  for (const auto& row : table.rows) text += markdown_row(row);
  return text;
}

ordered_json json_of(const Entry& entry) {
  const auto limit = [](double value) { return std::isfinite(value) ? ordered_json(value) : ordered_json(); };
  ordered_json object{
      {"name", entry.name}, {"title", entry.title}, {"equation", entry.equation}, {"citation", entry.citation}};
  object["parameters"] = ordered_json::array();
  for (const auto& p : entry.parameters)
    object["parameters"].push_back({{"name", p.name},
                                    {"default", p.fallback},
                                    {"unit", p.unit},
                                    {"meaning", p.meaning},
                                    {"low", limit(p.low)},
                                    {"high", limit(p.high)},
                                    {"range", p.range()}});
  object["reads"] = entry.reads;
  object["adds"] = entry.adds;
  object["properties"] = ordered_json::object();
  for (const auto& [key, value] : entry.properties) object["properties"][key] = value;
  return object;
}

std::string entry_text(const Axis& axis, const Entry& entry) {
  std::string text = fmt::format("{}/{}\n  {}\n", axis.name, entry.name, entry.title);
  const auto line = [&](std::string_view key, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<11} {}\n", key, value);
  };
  for (const auto& [key, value] : entry.properties) line(key, value);
  line("equation", entry.equation);
  line("citation", entry.citation);
  line("reads", listed(entry.reads));
  line("adds", listed(entry.adds));
  if (entry.parameters.empty()) return text;

  TextTable table{{"parameter", "default", "unit", "range", "meaning"}, {}};
  for (const auto& p : entry.parameters)
    table.rows.push_back({p.name, fmt::format("{}", p.fallback), p.unit, p.range(), p.meaning});
  std::string lines = aligned(table);
  for (std::size_t at = 0; at < lines.size(); at = lines.find('\n', at) + 1) lines.insert(at, "  ");
  return text + "\n" + lines;
}

}  // namespace

std::string ParameterLine::range() const {
  constexpr double nearly_zero = 1e-200;  // a lower limit of 1e-300 says "positive"
  if (std::isfinite(low) && std::isfinite(high)) return fmt::format("{} to {}", low, high);
  if (std::isfinite(low)) return low > 0 && low < nearly_zero ? "> 0" : fmt::format(">= {}", low);
  return std::isfinite(high) ? fmt::format("<= {}", high) : "any";
}

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

std::string list_axes() {
  TextTable table{{"list", "entries", "what it holds"}, {}};
  for (const Axis& axis : axes()) table.rows.push_back({axis.name, std::to_string(axis.entries.size()), axis.title});
  return aligned(table);
}

std::string list_text(std::string_view name) {
  const Axis& axis = find_axis(name);
  TextTable table;
  add_column(table, axis, "name", [](const Entry& entry) { return entry.name; });
  add_properties(table, axis);
  add_column(table, axis, "title", [](const Entry& entry) { return entry.title; });
  add_column(table, axis, "citation", [](const Entry& entry) { return entry.citation; });
  return aligned(table);
}

std::string list_json(std::string_view name) {
  ordered_json array = ordered_json::array();
  for (const Entry& entry : find_axis(name).entries) array.push_back(json_of(entry));
  return array.dump(2) + "\n";
}

std::string list_markdown(std::string_view name) { return markdown_table(find_axis(name)); }

std::string show_text(std::string_view name) {
  std::string text;
  for (const auto& [axis, entry] : find_entries(name)) text += (text.empty() ? "" : "\n") + entry_text(*axis, *entry);
  return text;
}

std::string show_json(std::string_view name) {
  ordered_json array = ordered_json::array();
  for (const auto& [axis, entry] : find_entries(name)) {
    ordered_json object{{"axis", axis->name}};
    object.update(json_of(*entry));
    array.push_back(object);
  }
  return array.dump(2) + "\n";
}

std::string docs_tables() {
  std::string text =
      "<!-- Generated by `undine list --markdown`. Do not edit: change the source that a line comes from. -->\n"
      "# Everything that a case file can choose\n";
  for (const Axis& axis : axes())
    text += fmt::format("\n## {} (`{}`)\n\n{}", axis.title, axis.name, markdown_table(axis));
  return text;
}

}  // namespace undine
