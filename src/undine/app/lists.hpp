#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace undine {

/// One number of an entry that a case file may set.
struct ParameterLine {
  std::string name;
  double fallback;  ///< the value where a case does not say
  std::string unit;
  std::string meaning;
  double low, high;  ///< infinite where there is no limit

  /// "any", ">= 0", "> 0", "0 to 1".
  std::string range() const;
};

/// One entry of an axis: what its struct says of itself, as text.
struct Entry {
  std::string name, title;
  std::string equation = {}, citation = {};  ///< empty where there is none
  std::vector<ParameterLine> parameters = {};
  std::vector<std::string> reads = {}, adds = {};                    ///< names of fields
  std::vector<std::pair<std::string, std::string>> properties = {};  ///< what only this axis has: "kappa", "unit", ...
};

/// One thing that a case file chooses, and all that it may choose from.
struct Axis {
  std::string name, title;
  std::vector<Entry> entries;
};

/// Every axis. Derived from the lists of the physics, the searches, the backends and fields.def.
const std::vector<Axis>& axes();

/// The axis of that name. Throws InputError that names the nearest one.
const Axis& find_axis(std::string_view name);

/// An entry with the axis that it stands in.
struct Found {
  const Axis* axis;
  const Entry* entry;
};

/// The entries of that name, of whatever axis; `axis/name` picks one. Throws InputError that names the nearest one.
std::vector<Found> find_entries(std::string_view name);

/// All axes with the number of their entries, an aligned table.
std::string list_axes();

/// The entries of one axis: an aligned table; JSON, an array of objects; a markdown table. Throws InputError.
std::string list_text(std::string_view axis);
std::string list_json(std::string_view axis);
std::string list_markdown(std::string_view axis);

/// All that is known of the entries that `find_entries` finds.
std::string show_text(std::string_view name);
std::string show_json(std::string_view name);

/// The file docs/tables.md: every axis as a markdown table.
std::string docs_tables();

}  // namespace undine
