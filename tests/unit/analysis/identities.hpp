#pragma once
#include <cmath>
#include <filesystem>
#include <string>

#include "undine/io/time_series.hpp"

namespace undine::test {

/// A table of tests/data/exact.
inline CsvTable table(const std::string& file) {
  return read_csv(std::filesystem::path(UNDINE_TEST_DATA) / "exact" / file);
}

/// Central differences of fourth order.
template <class F>
double slope(F&& f, double at, double d) {
  return (8 * (f(at + d) - f(at - d)) - (f(at + 2 * d) - f(at - 2 * d))) / (12 * d);
}
template <class F>
double curvature(F&& f, double at, double d) {
  return (16 * (f(at + d) + f(at - d)) - (f(at + 2 * d) + f(at - 2 * d)) - 30 * f(at)) / (12 * d * d);
}

}  // namespace undine::test
