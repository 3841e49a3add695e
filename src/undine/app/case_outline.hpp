#pragma once
#include <string>
#include <utility>
#include <vector>

#include "undine/app/run/options.hpp"
#include "undine/io/time_series.hpp"

namespace undine {

/// What can be said of a run before it begins.
struct CaseOutline {
  std::string hash;  ///< of every key that was read, with its value
  int dimensions = 3;
  double spacing = 0, support = 0;  ///< m
  double end = 0, step = 0;         ///< s; the step is the fixed one, or what speeds and viscosity allow at first
  double fluid = 0, wall = 0;       ///< particles
  std::vector<std::pair<std::string, std::vector<SeriesColumn>>> series;  ///< "energies" and each gauge: its columns
  std::vector<std::string> warnings;

  double particles() const { return fluid + wall; }
  double steps() const { return end / step; }
  /// Pairs of fluid particles with neighbours that all steps evaluate.
  double pairs() const;
  /// Fields and neighbour lists of the run, bytes, about.
  double memory() const;
};

/// Reads a case with everything that it names, as `undine check` does. Throws InputError.
CaseOutline outline_case(const RunOptions& options);

}  // namespace undine
