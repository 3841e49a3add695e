#include "undine/app/study/limit.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "undine/app/study/table.hpp"

namespace undine::study {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A number with the part of its name that says whose it is.
struct Found {
  std::string whose;
  double value;
};

/// "spacing 0.02, wall adami": the values of the axes in which members differ; `without`: an axis that does not count.
std::string whose(const StudyFile& study, const Choice& choice, std::optional<std::size_t> without) {
  std::string text;
  for (std::size_t a = 0; a < choice.size(); ++a)
    if (study.axes[a].values.size() > 1 && without != a)
      text +=
          fmt::format("{}{} {}", text.empty() ? "" : ", ", study.axes[a].name, study.axes[a].values[choice[a]].name);
  return text;
}

/// Sorts numbers so that the farthest from what is wanted comes first; what could not be measured is worst.
double badness(const Limit& limit, double value) {
  if (std::isnan(value)) return std::numeric_limits<double>::infinity();
  return limit.bounded_below() && !limit.bounded_above() ? -value : value;
}

std::vector<Found> numbers_of(const Limit& limit, const StudyFile& study, const std::vector<Member>& members,
                              const ResultTable& table) {
  const auto names = study.variables();
  const auto column = static_cast<std::size_t>(std::ranges::find(names, limit.quantity) - names.begin());
  const auto value_of = [&](std::size_t k) {
    return members[k].status == Status::finished ? table.rows[k].values[column] : nan;
  };
  std::vector<Found> found;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (!holds(limit.selection, members[k].choice)) continue;
    double value = value_of(k);
    if (limit.relative_axis) {
      Choice other = members[k].choice;
      if (other[*limit.relative_axis] == limit.relative_value) continue;
      other[*limit.relative_axis] = limit.relative_value;
      const auto base = std::ranges::find(members, other, &Member::choice);
      value = base == members.end() ? nan : value / value_of(static_cast<std::size_t>(base - members.begin()));
    }
    found.push_back({whose(study, members[k].choice, {}), value});
  }
  return found;
}

std::vector<Found> orders_of(const Limit& limit, const StudyFile& study, const std::vector<Member>& members,
                             const ResultTable& table) {
  const std::size_t axis = *limit.order_over;
  std::map<Choice, std::size_t> counts;  // members of each group
  for (const Member& member : members) {
    Choice group = member.choice;
    group[axis] = 0;
    ++counts[group];
  }
  std::vector<Found> found;
  for (const Order& order : table.orders) {
    if (order.quantity != limit.quantity || order.axis != study.axes[axis].name) continue;
    if (!holds(limit.selection, order.choice) || counts[order.choice] < 2) continue;
    found.push_back({whose(study, order.choice, axis), order.order});
  }
  return found;
}

}  // namespace

std::string Score::limit_text() const {
  return limited() ? fmt::format("{} {:.4g}", is_upper ? "<=" : ">=", limit) : std::string();
}

std::vector<Score> judge_limits(const StudyFile& study, const std::vector<Member>& members, const ResultTable& table) {
  std::vector<Score> scores;
  for (const Limit& limit : study.limits) {
    if (study.quick && !limit.quick) continue;
    auto found = limit.order_over ? orders_of(limit, study, members, table) : numbers_of(limit, study, members, table);
    if (limit.worst && found.size() > 1) {
      std::ranges::stable_sort(found, std::greater{}, [&](const Found& f) { return badness(limit, f.value); });
      found.resize(1);
      found[0].whose = fmt::format("worst: {}", found[0].whose);
    }
    const auto quantity = std::ranges::find(study.quantities, limit.quantity, &Quantity::name);
    const bool pure = limit.order_over || limit.relative_axis;
    for (const Found& each : found) {
      Score score{.metric = each.whose.empty() ? limit.metric : fmt::format("{} ({})", limit.metric, each.whose),
                  .value = each.value,
                  .limit = nan,
                  .unit = pure ? std::string() : quantity->unit,
                  .source = limit.source};
      if (!limit.bounded_above() && !limit.bounded_below()) scores.push_back(score);
      if (limit.bounded_above()) {
        score.limit = limit.at_most;
        scores.push_back(score);
      }
      if (limit.bounded_below()) {
        score.limit = limit.at_least;
        score.is_upper = false;
        scores.push_back(score);
      }
    }
  }
  return scores;
}

}  // namespace undine::study
