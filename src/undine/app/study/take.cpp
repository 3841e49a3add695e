// From samples to one number.
#include <algorithm>
#include <cmath>

#include "undine/analysis/growth.hpp"
#include "undine/app/gauges/comparison.hpp"
#include "undine/app/study/quantity.hpp"

namespace undine::study {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Mean over time of f(v) by the trapezoidal rule, so that uneven samples do not weigh more where they are dense.
template <class F>
double time_mean(const Samples& s, F&& f) {
  if (s.times.size() == 1) return f(s.values[0]);
  double sum = 0;
  for (std::size_t k = 1; k < s.times.size(); ++k)
    sum += 0.5 * (f(s.values[k - 1]) + f(s.values[k])) * (s.times[k] - s.times[k - 1]);
  return sum / (s.times.back() - s.times.front());
}

/// The largest rise from an earlier to a later sample.
double largest_rise(const Samples& s) {
  double lowest = s.values[0], rise = 0;
  for (const double value : s.values) {
    lowest = std::min(lowest, value);
    rise = std::max(rise, value - lowest);
  }
  return rise;
}

/// RMS of the samples minus their mean over `period` around them: straight lines leave nothing, what swings faster than
/// the period stays. Samples within half a period of the ends have no such mean and do not count.
double ripple(const Samples& s, double period) {
  double sum = 0;
  std::size_t count = 0, first = 0, last = 0;
  for (std::size_t k = 0; k < s.times.size(); ++k) {
    const double low = s.times[k] - 0.5 * period, high = s.times[k] + 0.5 * period;
    const double slack = 1e-9 * period;
    if (low < s.times.front() - slack || high > s.times.back() + slack) continue;
    while (s.times[first] < low - slack) ++first;
    while (last + 1 < s.times.size() && s.times[last + 1] <= high + slack) ++last;
    double mean = 0;
    for (std::size_t j = first; j <= last; ++j) mean += s.values[j] / static_cast<double>(last - first + 1);
    sum += (s.values[k] - mean) * (s.values[k] - mean);
    ++count;
  }
  return count == 0 ? nan : std::sqrt(sum / static_cast<double>(count));
}

double time_to(const Quantity& q, const Samples& s) {
  double found = infinity;
  for (std::size_t k = 0; k < s.times.size(); ++k) {
    const bool there = q.above ? s.values[k] > q.threshold : s.values[k] < q.threshold;
    if (there && found == infinity) found = s.times[k];
    if (there && !q.stays) break;
    if (!there) found = infinity;
  }
  return found;
}

double rms_after_shift(const ReferenceSeries& reference, const Samples& ours, double shift) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < reference.x.size(); ++k) {
    const double x = reference.x[k] + shift;
    if (x < ours.times.front() || x > ours.times.back()) continue;
    const double d = value_at(ours, x) - reference.y[k];
    sum += d * d;
    ++count;
  }
  // A run that broke early does not agree with what it never reached.
  return 2 * count < reference.x.size() ? nan : std::sqrt(sum / static_cast<double>(count));
}

}  // namespace

double take_from(const Quantity& q, const std::vector<double>& times, const std::vector<double>& values) {
  const double slack = 1e-9 * std::max(1.0, std::abs(q.start));
  const Samples s = between(finite({times, values}), q.start - slack, q.end * (1 + 1e-9));
  if (s.times.empty()) return nan;
  switch (q.take) {
    case Take::last:
      return s.values.back();
    case Take::first:
      return s.values.front();
    case Take::max:
      return *std::ranges::max_element(s.values);
    case Take::min:
      return *std::ranges::min_element(s.values);
    case Take::mean:
      return time_mean(s, [](double v) { return v; });
    case Take::rms:
      return std::sqrt(time_mean(s, [](double v) { return v * v; }));
    case Take::growth:
      return s.values.back() - s.values.front();
    case Take::growth_rate:
      return slope(s.times, s.values);
    case Take::rise:
      return largest_rise(s);
    case Take::ripple:
      return ripple(s, q.period);
    case Take::time_to:
      return time_to(q, s);
    case Take::deviation:
      break;
  }
  return nan;
}

double deviation(const ReferenceSeries& reference, const std::vector<double>& x, const std::vector<double>& y) {
  const Samples ours = finite({x, y});
  if (ours.times.empty() || !std::ranges::is_sorted(ours.times)) return nan;
  const int trials = reference.shift > 0 ? 200 : 0;
  double best = rms_after_shift(reference, ours, 0);
  for (int k = -trials; k <= trials && trials > 0; ++k)
    best = std::fmin(best, rms_after_shift(reference, ours, reference.shift * k / trials));
  if (!reference.relative) return best;
  const auto [least, most] = std::ranges::minmax(reference.y);
  return best / (most - least);
}

}  // namespace undine::study
