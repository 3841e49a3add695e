#include "undine/app/study/study_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "undine/core/nearest.hpp"
#include "undine/core/units.hpp"

namespace undine::study {
namespace {

constexpr std::size_t most_members = 10000;

bool is_identifier(const std::string& name) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
  return !name.empty() && letter(name[0]) &&
         std::ranges::all_of(name, [&](char c) { return letter(c) || std::isdigit(static_cast<unsigned char>(c)); });
}

/// A text of TOML without the quotes of a string.
std::string unquoted(const std::string& text) {
  const bool quoted = text.size() >= 2 && (text[0] == '\'' || text[0] == '"') && text.back() == text[0];
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// "0.02" or "20 mm" as a number in SI units; NaN for anything else.
double number_in(const std::string& text) {
  try {
    return parse_quantity(text).value;
  } catch (const InputError&) {
    return std::nan("");
  }
}

std::vector<std::string> names_of(const std::vector<AxisValue>& values) {
  std::vector<std::string> names;
  for (const AxisValue& value : values) names.push_back(value.name);
  return names;
}

std::vector<std::string> names_of(const std::vector<Axis>& axes) {
  std::vector<std::string> names;
  for (const Axis& axis : axes) names.push_back(axis.name);
  return names;
}

/// Marks a name as taken; names of axes, facts and quantities stand beside each other in formulas.
void claim(const Table& table, const std::string& name, std::set<std::string>& names) {
  if (!is_identifier(name))
    table.fail("name", fmt::format("'{}' cannot be a name in formulas", shortened(name, 40)), {},
               "use letters, digits and '_', a letter first");
  const std::vector<std::string> keys{"source",     "reason",      "verdicts", "quantities", "within", "quantity",
                                      "order_over", "relative_to", "at_most",  "at_least",   "worst",  "metric"};
  if (std::ranges::count(keys, name) > 0)
    table.fail("name", fmt::format("'{}' is taken: it is a key of [[published]] or [[limit]]", name), {},
               "choose another name");
  const auto& facts = RunFacts::names();
  if (std::ranges::count(facts, name) > 0)
    table.fail("name", fmt::format("'{}' is taken: it is a fact of each run", name), listed(facts), "choose another");
  if (!names.insert(name).second) table.fail("name", fmt::format("'{}' is defined twice", name), {}, "rename one");
}

/// The case that key `case` names, which must exist.
std::filesystem::path read_base(const Table& table) {
  const std::filesystem::path file = table.path("case");
  if (!std::filesystem::is_regular_file(file))
    table.fail("case", fmt::format("there is no file '{}'", file.string()), {},
               "check the path; names are relative to the study file's folder");
  return file;
}

AxisValue read_value(const Table& table) {
  AxisValue value{.name = table.text("name"),
                  .set = table.leaves("set"),
                  .base = {},
                  .number = std::nan(""),
                  .from = {},
                  .into = {}};
  if (table.has("case")) value.base = read_base(table);
  if (table.has("number")) value.number = table.number("number");
  if (table.has("from")) {
    value.from = table.text("from");
    value.into = table.text("into", "fluid[0].particles");
  }
  return value;
}

/// A value that starts from itself by way of others would never start.
void refuse_cycle(const Table& table, const Axis& axis, const AxisValue& value) {
  const AxisValue* at = &value;
  for (std::size_t steps = 0; !at->from.empty(); ++steps) {
    at = &*std::ranges::find(axis.values, at->from, &AxisValue::name);
    if (steps > axis.values.size())
      table.fail("value", fmt::format("'{}' starts from itself by way of '{}'", value.name, value.from), {},
                 "leave one 'from' out");
  }
}

Axis read_axis(const Table& table) {
  Axis axis{table.text("name"), {}};
  if (table.has("values")) {
    std::vector<std::string> keys = table.has("keys") ? table.texts("keys") : std::vector<std::string>{};
    if (keys.empty()) keys.push_back(table.text("key"));
    for (const Table::Literal& literal : table.literals("values")) {
      const std::string name = unquoted(literal.text);
      AxisValue value{.name = name, .set = {}, .base = {}, .number = number_in(name), .from = {}, .into = {}};
      for (const std::string& key : keys) value.set.push_back({key, literal.text, literal.where});
      axis.values.push_back(std::move(value));
    }
  }
  for (const Table& value : table.tables("value")) axis.values.push_back(read_value(value));
  if (axis.values.empty())
    table.fail("values", fmt::format("the axis '{}' has no values", axis.name), {},
               "add key = \"spacing\" and values = [0.02, 0.01], or [[axis.value]] tables");
  std::set<std::string> names;
  for (const AxisValue& value : axis.values)
    if (!names.insert(value.name).second)
      table.fail("values", fmt::format("the axis '{}' has the value '{}' twice", axis.name, value.name), {},
                 "remove one, or give it another name");
  const auto all = names_of(axis.values);
  for (const AxisValue& value : axis.values)
    if (!value.from.empty() && (std::ranges::count(all, value.from) == 0 || value.from == value.name))
      table.fail("value", fmt::format("'{}' cannot start from '{}'", value.name, value.from),
                 "'from' names another value of the same axis: " + listed(all), did_you_mean(value.from, all));
  for (const AxisValue& value : axis.values) refuse_cycle(table, axis, value);
  return axis;
}

/// Values of axes that a table names, "kernel = 'spiky'" or "kernel = ['spiky', 'poly6']".
Selection read_selection(const Table& table, const std::vector<Axis>& axes) {
  Selection selection(axes.size());
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (!table.has(axes[a].name)) continue;
    const auto valid = names_of(axes[a].values);
    const bool one = table.is_text(axes[a].name);
    const auto chosen = one ? std::vector{table.choice(axes[a].name, valid)} : table.choices(axes[a].name, valid);
    for (const std::string& name : chosen)
      selection[a].push_back(static_cast<std::size_t>(std::ranges::find(valid, name) - valid.begin()));
  }
  return selection;
}

/// All choices that a selection holds, the last axis fastest.
void enumerate(const std::vector<Axis>& axes, const Selection& selection, Choice& choice, std::vector<Choice>& all) {
  const std::size_t a = choice.size();
  if (a == axes.size()) {
    if (std::ranges::count(all, choice) == 0) all.push_back(choice);
    return;
  }
  for (std::size_t v = 0; v < axes[a].values.size(); ++v) {
    if (!selection[a].empty() && std::ranges::count(selection[a], v) == 0) continue;
    choice.push_back(v);
    enumerate(axes, selection, choice, all);
    choice.pop_back();
  }
}

std::vector<Choice> read_members(const Table& root, const std::vector<Axis>& axes) {
  double count = 1;
  for (const Axis& axis : axes) count *= static_cast<double>(axis.values.size());
  if (count > most_members)
    throw InputError({.what = fmt::format("the axes have {:.0f} combinations", count),
                      .where = root.where("axis"),
                      .why = fmt::format("at most {} are allowed", most_members),
                      .fix = "shorten them"});
  std::vector<Choice> all;
  Choice choice;
  const auto listed_members = root.tables("member");
  for (const Table& table : listed_members) enumerate(axes, read_selection(table, axes), choice, all);
  if (listed_members.empty()) enumerate(axes, Selection(axes.size()), choice, all);
  return all;
}

Published read_published(const Table& table, const StudyFile& study) {
  Published published{.selection = read_selection(table, study.axes),
                      .source = table.text("source", ""),
                      .reason = table.text("reason", ""),
                      .verdicts = {},
                      .quantities = {},
                      .within = table.in_range("within", unit::one, {0, 1e300}, 0.0)};
  std::vector<std::string> verdicts, quantities;
  for (const Verdict& verdict : study.verdicts) verdicts.push_back(verdict.name);
  for (const Quantity& quantity : study.quantities) quantities.push_back(quantity.name);
  const Table words = table.table("verdicts");
  for (const std::string& name : verdicts)
    if (words.has(name)) published.verdicts[name] = words.text(name);
  const Table numbers = table.table("quantities");
  for (const std::string& name : quantities)
    if (numbers.has(name)) published.quantities[name] = numbers.number(name);
  return published;
}

Limit read_limit(const Table& table, const StudyFile& study) {
  std::vector<std::string> quantities;
  for (const Quantity& quantity : study.quantities) quantities.push_back(quantity.name);
  Limit limit{.quantity = table.choice("quantity", quantities)};
  limit.selection = read_selection(table, study.axes);
  if (table.has("order_over")) {
    const auto axes = names_of(study.axes);
    const std::string axis = table.choice("order_over", axes);
    limit.order_over = static_cast<std::size_t>(std::ranges::find(axes, axis) - axes.begin());
  }
  if (table.has("relative_to")) {
    const Selection other = read_selection(table.table("relative_to"), study.axes);
    for (std::size_t a = 0; a < other.size(); ++a)
      if (other[a].size() == 1 && !limit.relative_axis) {
        limit.relative_axis = a;
        limit.relative_value = other[a][0];
      } else if (!other[a].empty()) {
        table.fail("relative_to", "it must name one value of one axis", {}, "write relative_to = { AXIS = \"VALUE\" }");
      }
    if (!limit.relative_axis || limit.order_over)
      table.fail("relative_to", "it must name one value of one axis, and goes with no 'order_over'");
  }
  if (table.has("at_most")) limit.at_most = table.number("at_most");
  if (table.has("at_least")) limit.at_least = table.number("at_least");
  limit.worst = table.flag("worst", false);
  limit.quick = table.flag("quick", false);
  limit.source = table.text("source", "");
  limit.metric = table.text("metric", limit.order_over ? "observed order of " + limit.quantity : limit.quantity);
  if (std::ranges::none_of(study.members, [&](const Choice& choice) { return holds(limit.selection, choice); }))
    table.fail("quantity", "no member has the values that this limit names", {},
               "leave an axis out, or add the member");
  return limit;
}

/// An order that a limit needs is tabulated like any other.
void add_order(StudyFile& study, const Limit& limit) {
  if (limit.order_over && std::ranges::none_of(study.orders, [&](const OrderSpec& order) {
        return order.quantity == limit.quantity && order.axis == *limit.order_over;
      }))
    study.orders.push_back({limit.quantity, *limit.order_over});
}

/// Members that [quick] keeps: those whose values it names.
std::vector<Choice> reduced(const std::vector<Choice>& members, const Selection& kept) {
  std::vector<Choice> all;
  for (const Choice& choice : members)
    if (holds(kept, choice)) all.push_back(choice);
  return all;
}

}  // namespace

bool holds(const Selection& selection, const Choice& choice) {
  for (std::size_t a = 0; a < choice.size(); ++a)
    if (!selection[a].empty() && std::ranges::count(selection[a], choice[a]) == 0) return false;
  return true;
}

Expression::Variables StudyFile::variables() const {
  Expression::Variables names = RunFacts::names();
  for (const Axis& axis : axes) names.push_back(axis.name);
  for (const Quantity& quantity : quantities) names.push_back(quantity.name);
  return names;
}

StudyFile read_study(const Document& document, const std::filesystem::path& file, bool quick) {
  const Table root = document.root();
  StudyFile study{.title = root.text("title", ""), .file = file, .base = {}, .set = root.leaves("set")};
  if (root.has("case")) study.base = read_base(root);
  if (root.has("case") && root.has("measure"))
    root.fail("measure", "the study has a case and a measurement", {}, "leave one of them out");
  study.measures_consistency = root.has("measure") && root.choice("measure", {"consistency"}) == "consistency";
  study.is_long = root.flag("long", false);
  study.quick = quick;
  std::set<std::string> names;
  for (const Table& table : root.tables("axis")) {
    study.axes.push_back(read_axis(table));
    claim(table, study.axes.back().name, names);
    for (const AxisValue& value : study.axes.back().values)
      if (study.base.empty() && value.base.empty() && root.tables("axis").size() == 1 && !study.measures_consistency)
        table.fail("value", fmt::format("'{}' has no case to run", value.name), {},
                   "add case = \"case.toml\" to it, or to the top of the file");
  }
  if (study.base.empty() && study.axes.empty() && !study.measures_consistency)
    throw InputError({.what = "the study has no case",
                      .where = root.where(),
                      .why = "nothing would run",
                      .fix = "add case = \"../cases/still_water.toml\""});
  study.members = read_members(root, study.axes);
  for (const Table& table : root.tables("quantity")) {
    Quantity quantity = read_quantity(table, study.variables());
    claim(table, quantity.name, names);
    study.quantities.push_back(std::move(quantity));
  }
  for (const Table& table : root.tables("verdict")) {
    study.verdicts.push_back(read_verdict(table, study.variables()));
    claim(table, study.verdicts.back().name, names);
  }
  for (const Table& table : root.tables("published")) study.published.push_back(read_published(table, study));
  for (const Table& table : root.tables("order")) {
    std::vector<std::string> quantities;
    for (const Quantity& quantity : study.quantities) quantities.push_back(quantity.name);
    const auto axes = names_of(study.axes);
    const std::string axis = table.choice("axis", axes);
    study.orders.push_back(
        {table.choice("quantity", quantities), static_cast<std::size_t>(std::ranges::find(axes, axis) - axes.begin())});
  }
  for (const Table& table : root.tables("limit")) {
    study.limits.push_back(read_limit(table, study));
    add_order(study, study.limits.back());
  }
  const Table reduced_to = root.table("quick");
  study.quick_set = reduced_to.leaves("set");
  const Selection kept = read_selection(reduced_to.table("axes"), study.axes);
  if (!quick) {
    study.quick_set.clear();
  } else if (!reduced_to.exists()) {
    throw InputError({.what = "the study has no [quick] table",
                      .where = root.where(),
                      .why = "it says what --quick runs",
                      .fix = "add [quick] with set = { time.end = \"5 ms\" } and axes = { NAME = [...] }"});
  } else {
    study.members = reduced(study.members, kept);
  }
  return study;
}

}  // namespace undine::study
