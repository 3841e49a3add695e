#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace undine {

/// Numbers over time, ascending (s); values may be NaN.
struct Samples {
  std::vector<double> times, values;
};

/// How a gauge's column agrees with published data, over the times that both cover. NaN where there is no such time.
struct Comparison {
  std::string gauge = {}, column = {}, unit = {};
  double rms = 0;                  ///< of ours (linear between samples) minus the reference, at the reference's times
  double range = 0;                ///< max - min of the reference
  double relative = 0;             ///< rms / range
  double peak = 0, peak_time = 0;  ///< largest of our samples; s
  double reference_peak = 0, reference_peak_time = 0;  ///< largest of the reference's; s
  std::size_t points = 0;                              ///< of the reference that were compared
};

/// Compares two series up to the time `until` (s). Values that are not finite do not count.
Comparison compare(const Samples& ours, const Samples& reference, double until);

/// The comparisons as aligned lines under a header; empty if there are none.
std::string comparison_table(std::span<const Comparison> comparisons);

/// The values of a series that are finite.
Samples finite(const Samples& all);
/// The part of a series with first <= time <= last.
Samples between(const Samples& all, double first, double last);
/// Linear between samples; the time is within their range.
double value_at(const Samples& series, double time);

}  // namespace undine
