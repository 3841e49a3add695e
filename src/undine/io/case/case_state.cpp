#include "undine/io/case/case_state.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "undine/core/nearest.hpp"

namespace undine {

std::size_t CaseState::open(std::string name, const toml::table* node, std::size_t parent, std::string_view key) {
  const auto [entry, is_new] = ids.try_emplace(name, opened.size());
  if (is_new) opened.push_back({std::move(name), node, parent, std::string(key), {}, {}});
  return entry->second;
}

void CaseState::know(std::size_t id, std::string_view key) {
  auto& known = opened[id].known;
  if (std::find(known.begin(), known.end(), key) == known.end()) known.emplace_back(key);
}

void CaseState::resolve(std::size_t id, std::string_view key, std::string value) {
  auto name = dotted(opened[id].name, key);
  if (resolved_keys.insert(name).second) resolved.push_back({std::move(name), std::move(value)});
}

SourceLocation CaseState::where(const toml::source_region& source) const {
  if (source.path && source.path->starts_with(override_prefix)) return {.file = *source.path};
  return {.file = file, .line = static_cast<int>(source.begin.line), .column = static_cast<int>(source.begin.column)};
}

SourceLocation CaseState::where(std::size_t id) const {
  while (id != 0 && opened[id].node == nullptr) id = opened[id].parent;
  if (id == 0) return {.file = file};
  return where(opened[id].node->source());
}

std::string dotted(std::string_view table, std::string_view key) {
  return table.empty() ? std::string(key) : fmt::format("{}.{}", table, key);
}

std::string placed(std::string_view table) {
  return table.empty() ? "at the top of the file" : fmt::format("in [{}]", table);
}

std::string found(const toml::node& node) {
  if (const auto* value = node.as_string()) return fmt::format("the string '{}'", shortened(value->get(), 40));
  if (const auto* value = node.as_integer()) return fmt::format("the whole number {}", value->get());
  if (const auto* value = node.as_floating_point()) return fmt::format("the number {}", value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  if (const auto* value = node.as_array()) return fmt::format("an array of {}", value->size());
  if (node.is_table()) return "a table";
  return "a date or time";
}

}  // namespace undine
