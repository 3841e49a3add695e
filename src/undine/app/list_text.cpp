#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/app/lists.hpp"
#include "undine/core/nearest.hpp"

namespace undine {
namespace {

using nlohmann::ordered_json;

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
