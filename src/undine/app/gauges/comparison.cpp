#include "undine/app/gauges/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace undine {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void find_peak(const Samples& series, double& value, double& time) {
  value = time = nan;
  if (series.times.empty()) return;
  const auto peak = std::ranges::max_element(series.values);
  value = *peak;
  time = series.times[static_cast<std::size_t>(peak - series.values.begin())];
}

}  // namespace

Samples finite(const Samples& all) {
  Samples kept;
  for (std::size_t k = 0; k < all.times.size(); ++k) {
    if (!std::isfinite(all.times[k]) || !std::isfinite(all.values[k])) continue;
    kept.times.push_back(all.times[k]);
    kept.values.push_back(all.values[k]);
  }
  return kept;
}

Samples between(const Samples& all, double first, double last) {
  Samples kept;
  for (std::size_t k = 0; k < all.times.size(); ++k) {
    if (all.times[k] < first || all.times[k] > last) continue;
    kept.times.push_back(all.times[k]);
    kept.values.push_back(all.values[k]);
  }
  return kept;
}

double value_at(const Samples& series, double time) {
  const auto above = std::ranges::lower_bound(series.times, time);
  const auto k = static_cast<std::size_t>(above - series.times.begin());
  if (k == 0 || *above == time) return series.values[k];
  const double part = (time - series.times[k - 1]) / (series.times[k] - series.times[k - 1]);
  return (1 - part) * series.values[k - 1] + part * series.values[k];
}

Comparison compare(const Samples& ours, const Samples& reference, double until) {
  const Samples all = finite(ours);
  Comparison result;
  Samples theirs;
  if (!all.times.empty()) theirs = between(finite(reference), all.times.front(), std::min(until, all.times.back()));
  result.points = theirs.times.size();
  find_peak(theirs, result.reference_peak, result.reference_peak_time);
  result.rms = result.range = result.relative = result.peak = result.peak_time = nan;
  if (result.points == 0) return result;
  const auto [first, last] = std::ranges::minmax(theirs.times);
  find_peak(between(all, first, last), result.peak, result.peak_time);
  const auto [least, most] = std::ranges::minmax(theirs.values);
  double sum = 0;
  for (std::size_t k = 0; k < result.points; ++k) sum += std::pow(value_at(all, theirs.times[k]) - theirs.values[k], 2);
  result.rms = std::sqrt(sum / static_cast<double>(result.points));
  result.range = most - least;
  result.relative = result.range > 0 ? result.rms / result.range : nan;
  return result;
}

std::string comparison_table(std::span<const Comparison> comparisons) {
  if (comparisons.empty()) return {};
  std::vector<std::vector<std::string>> rows{
      {"gauge", "column", "points", "rms", "range", "rms/range", "peak", "at", "reference peak", "at"}};
  const auto number = [](double value, std::string_view unit) {
    return std::isfinite(value) ? fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit) : std::string("-");
  };
  for (const Comparison& c : comparisons)
    rows.push_back({c.gauge, c.column, std::to_string(c.points), number(c.rms, c.unit), number(c.range, c.unit),
                    std::isfinite(c.relative) ? fmt::format("{:.1f} %", 100 * c.relative) : "-", number(c.peak, c.unit),
                    number(c.peak_time, "s"), number(c.reference_peak, c.unit), number(c.reference_peak_time, "s")});
  std::vector<std::size_t> widths(rows[0].size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k)
      text += k < 2 ? fmt::format("{:<{}}  ", row[k], widths[k]) : fmt::format("{:>{}}  ", row[k], widths[k]);
    text.resize(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
}

}  // namespace undine
