#include "undine/io/case/table.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "undine/core/nearest.hpp"
#include "undine/io/case/case_value.hpp"

namespace undine {
namespace {

std::string shown(double value) { return fmt::format("{}", value); }
std::string shown(std::int64_t value) { return fmt::format("{}", value); }
std::string shown(const std::string& value) { return value; }
std::string shown(const Expression& value) { return value.source(); }
std::string shown(const Quantity& value) { return text(value); }

template <class T>
std::string shown_all(const std::vector<T>& values) {
  std::vector<std::string> words;
  for (const auto& value : values) words.push_back(shown(value));
  return fmt::format("[{}]", listed(words));
}

std::string shown_all(const std::vector<double>& values, Dimension dimension) {
  return dimension == unit::one ? shown_all(values) : fmt::format("{} {}", shown_all(values), text(dimension));
}

/// One handle's access to the file, shared by all readers.
struct Access {
  CaseState& state;
  std::size_t id;
  std::string_view key;

  const toml::node* find() const {
    state.know(id, key);
    auto& opened = state.opened[id];
    opened.read.emplace(key);
    return opened.node ? opened.node->get(key) : nullptr;
  }

  Value value(const toml::node& node) const { return {state, node, std::string(key), state.opened[id].name}; }

  /// The key is missing and has no fallback. A near miss in the file is probably what was meant.
  [[noreturn]] void missing(std::string_view example) const {
    auto absent = id;  // the outermost table that the file lacks, else the key itself
    std::string wanted(key);
    const toml::table* node = state.opened[id].node;
    for (; node == nullptr && absent != 0; absent = state.opened[absent].parent) {
      wanted = state.opened[absent].key;
      node = state.opened[state.opened[absent].parent].node;
    }
    std::vector<std::string> present;
    for (const auto& [name, value] : *node)
      if (!state.opened[absent].read.contains(name.str())) present.emplace_back(name.str());
    const auto meant = nearest(wanted, present);
    const auto& table = state.opened[id].name;
    throw InputError({.what = fmt::format("'{}' is missing {}", key, placed(table)),
                      .where = state.where(id),
                      .why = state.opened[id].node ? "it has no default" : fmt::format("the file has no [{}]", table),
                      .fix = fmt::format("add {} = {}", key, example) +
                             (meant.empty() ? "" : fmt::format(" (or was '{}' meant to be '{}'?)", meant, wanted))});
  }

  /// Reads the value with `convert`, or takes the fallback, and notes it for Document::resolved.
  template <class T, class Convert, class Show>
  T read(const std::optional<T>& fallback, std::string_view example, Convert&& convert, Show&& show) const {
    const auto* node = find();
    if (!node && !fallback) missing(example);
    T result = node ? convert(value(*node)) : *fallback;
    state.resolve(id, key, show(result));
    return result;
  }

  template <class T, class Convert, class Show>
  std::vector<T> read_all(const std::vector<T>* fallback, int count, std::string_view example, Convert&& convert,
                          Show&& show) const {
    const auto* node = find();
    if (!node && !fallback) missing(fmt::format("[{}]", example));
    std::vector<T> result;
    if (node) {
      const auto whole = value(*node);
      const auto* array = node->as_array();
      if (!array) whole.wrong_type("an array", fmt::format("[{}]", example));
      if (count >= 0 && array->size() != static_cast<std::size_t>(count))
        whole.refuse(fmt::format("'{}' needs {} values, but has {}", key, count, array->size()), {},
                     fmt::format("give {}", count));
      for (std::size_t k = 0; k < array->size(); ++k)
        result.push_back(convert(Value{state, (*array)[k], fmt::format("{}[{}]", key, k), whole.table}));
    } else {
      result = *fallback;
    }
    state.resolve(id, key, show(result));
    return result;
  }
};

std::vector<double> read_quantities(const Access& access, Dimension dimension, int count,
                                    const std::vector<double>* fallback) {
  return access.read_all<double>(
      fallback, count, example_of(dimension), [&](const Value& v) { return as_quantity(v, dimension); },
      [&](const std::vector<double>& all) { return shown_all(all, dimension); });
}

std::vector<std::int64_t> read_integers(const Access& access, int count, const std::vector<std::int64_t>* fallback) {
  return access.read_all<std::int64_t>(fallback, count, "100", as_integer, shown_all<std::int64_t>);
}

std::vector<std::string> read_choices(const Access& access, const std::vector<std::string>& valid,
                                      const std::vector<std::string>* fallback) {
  std::vector<std::string> before;
  const auto convert = [&](const Value& value) {
    auto word = as_choice(value, valid);
    if (std::find(before.begin(), before.end(), word) != before.end())
      value.refuse(fmt::format("'{}' is in '{}' twice", word, access.key), {}, "remove one");
    before.push_back(word);
    return word;
  };
  const auto example = valid.empty() ? std::string() : fmt::format("\"{}\"", valid.front());
  return access.read_all<std::string>(fallback, -1, example, convert, shown_all<std::string>);
}

std::vector<Expression> read_expressions(const Access& access, int count, const std::vector<Expression>* fallback,
                                         const Expression::Constants& constants) {
  return access.read_all<Expression>(
      fallback, count, "\"0.1 * sin(2 * pi * x)\"", [&](const Value& v) { return as_expression(v, constants); },
      shown_all<Expression>);
}

template <class Accept>
double read_checked(const Access& access, Dimension dimension, const std::optional<double>& fallback, Accept&& accept,
                    const std::string& rule) {
  return access.read<double>(
      fallback, example_of(dimension),
      [&](const Value& value) {
        const double number = as_quantity(value, dimension);
        if (!accept(number))
          value.refuse(fmt::format("'{}' must be {}, but is {}", value.name, rule, text(Quantity{number, dimension})),
                       {}, fmt::format("give a value that is {}", rule));
        return number;
      },
      [&](double number) {
        return shown(Quantity{number, dimension});
      });
}

}  // namespace

bool Table::has(std::string_view key) const {
  state_->know(id_, key);
  const auto* node = state_->opened[id_].node;
  return node && node->contains(key);
}

bool Table::is_text(std::string_view key) const {
  state_->know(id_, key);
  const auto* node = state_->opened[id_].node;
  const auto* value = node ? node->get(key) : nullptr;
  return value && value->is_string();
}

bool Table::exists() const { return state_->opened[id_].node != nullptr; }

std::vector<std::string> Table::keys() const {
  std::vector<std::string> names;
  if (const auto* node = state_->opened[id_].node)
    for (const auto& entry : *node) names.emplace_back(entry.first.str());
  return names;
}

std::string Table::name() const { return state_->opened[id_].name; }

double Table::number(std::string_view key, std::optional<double> fallback) const {
  const auto convert = [](const Value& value) {
    const auto result = bare(value);
    if (!result) value.wrong_type("a plain number", "0.5");
    return *result;
  };
  return Access{*state_, id_, key}.read<double>(fallback, "0.5", convert, [](double v) { return shown(v); });
}

double Table::quantity(std::string_view key, Dimension dimension, std::optional<double> fallback) const {
  return read_checked({*state_, id_, key}, dimension, fallback, [](double) { return true; }, {});
}

double Table::positive(std::string_view key, Dimension dimension, std::optional<double> fallback) const {
  return read_checked(
      {*state_, id_, key}, dimension, fallback, [](double v) { return v > 0; }, "greater than 0");
}

double Table::non_negative(std::string_view key, Dimension dimension, std::optional<double> fallback) const {
  return read_checked(
      {*state_, id_, key}, dimension, fallback, [](double v) { return v >= 0; }, "0 or more");
}

double Table::in_range(std::string_view key, Dimension dimension, Range range, std::optional<double> fallback) const {
  const auto rule = fmt::format("from {} to {}", range.low, shown(Quantity{range.high, dimension}));
  return read_checked(
      {*state_, id_, key}, dimension, fallback, [&](double v) { return v >= range.low && v <= range.high; }, rule);
}

std::int64_t Table::integer(std::string_view key, std::optional<std::int64_t> fallback) const {
  return Access{*state_, id_, key}.read<std::int64_t>(fallback, "100", as_integer,
                                                      [](std::int64_t v) { return shown(v); });
}

bool Table::flag(std::string_view key, std::optional<bool> fallback) const {
  const auto convert = [](const Value& value) {
    const auto* result = value.node.as_boolean();
    if (!result) value.wrong_type("true or false", "true");
    return result->get();
  };
  return Access{*state_, id_, key}.read<bool>(fallback, "true", convert, [](bool v) { return v ? "true" : "false"; });
}

std::string Table::text(std::string_view key, std::optional<std::string> fallback) const {
  return Access{*state_, id_, key}.read<std::string>(fallback, "\"text\"", as_text,
                                                     [](const std::string& v) { return v; });
}

std::string Table::choice(std::string_view key, const std::vector<std::string>& valid,
                          std::optional<std::string> fallback) const {
  const auto example = valid.empty() ? std::string() : fmt::format("\"{}\"", valid.front());
  return Access{*state_, id_, key}.read<std::string>(
      fallback, example, [&](const Value& v) { return as_choice(v, valid); }, [](const std::string& v) { return v; });
}

std::filesystem::path Table::path(std::string_view key, std::optional<std::string> fallback) const {
  const auto convert = [](const Value& value) {
    auto name = as_text(value);
    if (name.empty() || name.find('\0') != std::string::npos)
      value.refuse(fmt::format("'{}' is not a file name", value.name), {}, "name a file");
    return name;
  };
  const std::filesystem::path name = Access{*state_, id_, key}.read<std::string>(
      fallback, "\"file.csv\"", convert, [](const std::string& v) { return v; });
  return (state_->folder / name).lexically_normal();
}

Expression Table::expression(std::string_view key, const Expression::Constants& constants) const {
  return expression(key, std::nullopt, constants);
}

Expression Table::expression(std::string_view key, std::optional<Expression> fallback,
                             const Expression::Constants& constants) const {
  return Access{*state_, id_, key}.read<Expression>(
      fallback, "\"0.1 * sin(2 * pi * x)\"", [&](const Value& v) { return as_expression(v, constants); },
      [](const Expression& v) { return v.source(); });
}

std::vector<double> Table::quantities(std::string_view key, Dimension dimension, int count) const {
  return read_quantities({*state_, id_, key}, dimension, count, nullptr);
}

std::vector<double> Table::quantities(std::string_view key, Dimension dimension, int count,
                                      const std::vector<double>& fallback) const {
  return read_quantities({*state_, id_, key}, dimension, count, &fallback);
}

std::vector<std::int64_t> Table::integers(std::string_view key, int count) const {
  return read_integers({*state_, id_, key}, count, nullptr);
}

std::vector<std::int64_t> Table::integers(std::string_view key, int count,
                                          const std::vector<std::int64_t>& fallback) const {
  return read_integers({*state_, id_, key}, count, &fallback);
}

std::vector<std::string> Table::choices(std::string_view key, const std::vector<std::string>& valid) const {
  return read_choices({*state_, id_, key}, valid, nullptr);
}

std::vector<std::string> Table::choices(std::string_view key, const std::vector<std::string>& valid,
                                        const std::vector<std::string>& fallback) const {
  return read_choices({*state_, id_, key}, valid, &fallback);
}

std::vector<Expression> Table::expressions(std::string_view key, int count,
                                           const Expression::Constants& constants) const {
  return read_expressions({*state_, id_, key}, count, nullptr, constants);
}

std::vector<Expression> Table::expressions(std::string_view key, int count, const std::vector<Expression>& fallback,
                                           const Expression::Constants& constants) const {
  return read_expressions({*state_, id_, key}, count, &fallback, constants);
}

std::vector<std::string> Table::texts(std::string_view key) const {
  return Access{*state_, id_, key}.read_all<std::string>(nullptr, -1, "\"text\"", as_text, shown_all<std::string>);
}

std::vector<std::string> Table::texts(std::string_view key, const std::vector<std::string>& fallback) const {
  return Access{*state_, id_, key}.read_all<std::string>(&fallback, -1, "\"text\"", as_text, shown_all<std::string>);
}

Expression Table::formula(std::string_view key, const Expression::Variables& variables) const {
  return Access{*state_, id_, key}.read<Expression>(
      std::nullopt, "\"a + 2 * b\"", [&](const Value& v) { return as_formula(v, variables); },
      [](const Expression& v) { return v.source(); });
}

Table Table::table(std::string_view key) const {
  const Access access{*state_, id_, key};
  const auto* node = access.find();
  if (node && !node->is_table()) access.value(*node).wrong_type("a table", "{ ... }, or [" + std::string(key) + "]");
  return {state_, state_->open(dotted(name(), key), node ? node->as_table() : nullptr, id_, key)};
}

std::vector<Table> Table::tables(std::string_view key) const {
  const Access access{*state_, id_, key};
  const auto* node = access.find();
  if (!node) return {};
  const auto path = dotted(name(), key);
  const auto open = [&](const toml::table* table, std::size_t k) {
    return Table(state_, state_->open(fmt::format("{}[{}]", path, k), table, id_, key));
  };
  if (const auto* table = node->as_table()) return {open(table, 0)};
  const auto* array = node->as_array();
  if (!array) access.value(*node).wrong_type("an array of tables", "[{ ... }], or [[" + std::string(key) + "]]");
  std::vector<Table> all;
  for (std::size_t k = 0; k < array->size(); ++k) {
    const auto* table = (*array)[k].as_table();
    if (!table) Value{*state_, (*array)[k], fmt::format("{}[{}]", key, k), name()}.wrong_type("a table", "[{ ... }]");
    all.push_back(open(table, k));
  }
  return all;
}

SourceLocation Table::where() const { return state_->where(id_); }

SourceLocation Table::where(std::string_view key) const {
  const auto* node = state_->opened[id_].node;
  const auto* value = node ? node->get(key) : nullptr;
  return value ? state_->where(value->source()) : where();
}

void Table::fail(std::string_view key, std::string what, std::string why, std::string fix) const {
  throw InputError({.what = std::move(what), .where = where(key), .why = std::move(why), .fix = std::move(fix)});
}

}  // namespace undine
