// Values that a document only passes on to another one, as text.
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "undine/io/case/case_value.hpp"
#include "undine/io/case/table.hpp"

namespace undine {
namespace {

/// A key as it can stand in a dotted path of Document::set.
std::string step_of(const toml::key& key) { return std::string(key.str()); }

/// The node as TOML on one line.
std::string one_line(const toml::node& node) {
  std::ostringstream text;
  if (const auto* table = node.as_table()) {
    text << "{";
    bool first = true;
    for (const auto& [key, value] : *table) {
      text << (std::exchange(first, false) ? " " : ", ") << "'" << key.str() << "' = " << one_line(value);
    }
    text << " }";
  } else if (const auto* array = node.as_array()) {
    text << "[";
    for (std::size_t k = 0; k < array->size(); ++k) text << (k ? ", " : "") << one_line((*array)[k]);
    text << "]";
  } else if (const auto* real = node.as_floating_point()) {
    text << fmt::format("{}", real->get());
  } else if (const auto* string = node.as_string(); string && string->get().empty()) {
    return {};  // takes the key out of the other document
  } else if (string) {
    text << toml::toml_formatter{*string,
                                 toml::toml_formatter::default_flags & ~toml::format_flags::allow_multi_line_strings};
  } else {
    node.visit([&](const auto& value) {
      if constexpr (toml::is_value<decltype(value)>) text << value;
    });
  }
  return text.str();
}

/// Marks everything below as read: what it means is for the other document to say.
void read_all(CaseState& state, std::size_t id) {
  const toml::table* node = state.opened[id].node;
  if (!node) return;
  for (const auto& [key, value] : *node) {
    state.know(id, key.str());
    state.opened[id].read.emplace(key.str());
    if (const auto* inner = value.as_table())
      read_all(state, state.open(dotted(state.opened[id].name, key.str()), inner, id, key.str()));
    const auto* array = value.as_array();
    for (std::size_t k = 0; array && k < array->size(); ++k)
      if (const auto* element = (*array)[k].as_table())
        read_all(state, state.open(fmt::format("{}[{}]", dotted(state.opened[id].name, key.str()), k), element, id,
                                   key.str()));
  }
}

void collect(const CaseState& state, const toml::table& table, const std::string& path,
             std::vector<Table::Literal>& all) {
  for (const auto& [key, value] : table) {
    const std::string here = path.empty() ? step_of(key) : path + "." + step_of(key);
    if (const auto* inner = value.as_table()) {
      collect(state, *inner, here, all);
    } else {
      all.push_back({here, one_line(value), state.where(key.source())});
    }
  }
}

}  // namespace

std::vector<Table::Literal> Table::literals(std::string_view key) const {
  state_->know(id_, key);
  state_->opened[id_].read.emplace(key);
  const auto* node = state_->opened[id_].node ? state_->opened[id_].node->get(key) : nullptr;
  if (!node) fail(key, fmt::format("'{}' is missing {}", key, placed(name())), {}, fmt::format("add {} = [...]", key));
  const auto* array = node->as_array();
  if (!array) Value{*state_, *node, std::string(key), name()}.wrong_type("an array", "[1, 2]");
  std::vector<Literal> all;
  std::string shown;
  for (std::size_t k = 0; k < array->size(); ++k) {
    const toml::node& element = (*array)[k];
    if (const auto* inner = element.as_table())
      read_all(*state_, state_->open(fmt::format("{}[{}]", dotted(name(), key), k), inner, id_, key));
    all.push_back({{}, one_line(element), state_->where(element.source())});
    shown += (k ? ", " : "") + all.back().text;
  }
  state_->resolve(id_, key, "[" + shown + "]");
  return all;
}

std::vector<Table::Literal> Table::leaves(std::string_view key) const {
  const Table inner = table(key);
  std::vector<Literal> all;
  const toml::table* node = state_->opened[inner.id_].node;
  if (!node) return all;
  read_all(*state_, inner.id_);
  collect(*state_, *node, {}, all);
  for (const Literal& each : all) state_->resolve(inner.id_, each.path, each.text);
  return all;
}

}  // namespace undine
