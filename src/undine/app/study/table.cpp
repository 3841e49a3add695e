#include "undine/app/study/table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "undine/analysis/growth.hpp"
#include "undine/core/error.hpp"

namespace undine::study {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The series files of one member, each read once.
class Files {
 public:
  explicit Files(const Member& member) : member_(member) {}

  const CsvTable* find(const std::string& series) {
    const auto [entry, is_new] = read_.try_emplace(series);
    if (is_new) {
      const auto path =
          series == "energies" ? member_.folder / "energies.csv" : member_.folder / "gauges" / (series + ".csv");
      try {
        if (std::filesystem::exists(path)) entry->second = read_csv(path);
      } catch (const InputError&) {  // a row that a dying member cut short
      }
    }
    return entry->second && entry->second->rows > 0 ? &*entry->second : nullptr;
  }

 private:
  const Member& member_;
  std::map<std::string, std::optional<CsvTable>> read_;
};

double number_of(const Quantity& quantity, const std::vector<double>& values, Files& files, const Member& member) {
  if (!member.measured()) return nan;
  if (!quantity.fact.empty()) {
    const auto& names = RunFacts::names();
    return member.facts.values()[static_cast<std::size_t>(std::ranges::find(names, quantity.fact) - names.begin())];
  }
  if (quantity.formula) {
    // Values of quantities below this one are not there yet, and its formula cannot name them.
    std::vector<double> known = values;
    known.resize(values.size() + 1, nan);
    return quantity.formula->evaluate(known);
  }
  const CsvTable* file = files.find(quantity.series);
  return file ? measure(quantity, *file) : nan;
}

void add_published(Row& row, const StudyFile& study, const Member& member) {
  const std::size_t first = RunFacts::names().size() + study.axes.size();
  for (const Published& published : study.published) {
    if (!holds(published.selection, member.choice)) continue;
    for (std::size_t k = 0; k < study.verdicts.size(); ++k)
      if (const auto found = published.verdicts.find(study.verdicts[k].name); found != published.verdicts.end()) {
        row.published[found->first] = found->second;
        if (row.verdicts[k] != not_measured) row.agrees[found->first] = row.verdicts[k] == found->second;
      }
    for (std::size_t k = 0; k < study.quantities.size(); ++k)
      if (const auto found = published.quantities.find(study.quantities[k].name); found != published.quantities.end()) {
        row.published[found->first] = fmt::format("{:.6g}", found->second);
        const double ours = row.values[first + k];
        if (published.within > 0 && member.done() && std::isfinite(ours))
          row.agrees[found->first] = std::abs(ours - found->second) <= published.within * std::abs(found->second);
      }
    if (!published.reason.empty()) row.reasons.push_back(published.reason);
  }
}

/// The exponent of |q| ~ x^k for each group of members that differ in the axis alone.
void add_orders(ResultTable& table, const StudyFile& study, const std::vector<Member>& members, const OrderSpec& spec) {
  const auto names = study.variables();
  const auto column = static_cast<std::size_t>(std::ranges::find(names, spec.quantity) - names.begin());
  std::vector<Choice> groups;
  for (const Member& member : members) {
    Choice group = member.choice;
    group[spec.axis] = 0;
    if (std::ranges::count(groups, group) == 0) groups.push_back(group);
  }
  for (const Choice& group : groups) {
    std::vector<double> x, y;
    for (std::size_t k = 0; k < members.size(); ++k) {
      Choice choice = members[k].choice;
      const double at = study.axes[spec.axis].values[choice[spec.axis]].number;
      choice[spec.axis] = 0;
      const double value = std::abs(table.rows[k].values[column]);
      if (choice != group || members[k].status != Status::finished || !(at > 0) || !(value > 0) ||
          !std::isfinite(value))
        continue;
      x.push_back(at);
      y.push_back(value);
    }
    Order order{.quantity = spec.quantity,
                .axis = study.axes[spec.axis].name,
                .group = {},
                .choice = group,
                .order = growth_exponent(x, y)};
    for (std::size_t a = 0; a < group.size(); ++a)
      if (a != spec.axis) order.group[study.axes[a].name] = study.axes[a].values[group[a]].name;
    table.orders.push_back(std::move(order));
  }
}

}  // namespace

ResultTable tabulate(const StudyFile& study, const std::vector<Member>& members) {
  ResultTable table;
  for (const Member& member : members) {
    Row row{.values = member.facts.values(), .verdicts = {}, .published = {}, .agrees = {}, .reasons = {}};
    for (std::size_t a = 0; a < member.choice.size(); ++a)
      row.values.push_back(study.axes[a].values[member.choice[a]].number);
    Files files(member);
    for (const Quantity& quantity : study.quantities)
      row.values.push_back(number_of(quantity, row.values, files, member));
    for (const Verdict& verdict : study.verdicts)
      row.verdicts.push_back(member.done() ? judge(verdict, row.values) : not_measured);
    add_published(row, study, member);
    table.rows.push_back(std::move(row));
  }
  for (const OrderSpec& spec : study.orders) add_orders(table, study, members, spec);
  return table;
}

}  // namespace undine::study
