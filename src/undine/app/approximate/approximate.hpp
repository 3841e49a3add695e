#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace undine {

struct ApproximateOptions {
  std::filesystem::path points;     ///< CSV or snapshot
  std::vector<std::string> fields;  ///< which of its columns; all that are no coordinates or amounts
  std::string volume;               ///< of every point; empty: from the file
  std::optional<int> group;         ///< points of this group alone
  std::filesystem::path at;         ///< query points: CSV or snapshot; empty: the grid, or the points themselves
  std::vector<int> grid;            ///< nodes along each axis
  std::vector<double> low, high;    ///< corners of the grid; the bounds of the points
  std::string method = "mls";
  std::optional<int> order;
  std::string kernel = "wendland_c2";
  std::string support;  ///< H, with or without a unit
  double condition_limit = 1e10;
  std::filesystem::path out;
  int threads = 0;
  bool consistency = false;            ///< what methods make of polynomials, in place of an approximation
  std::vector<std::string> sets = {};  ///< "key=value" for it
};

void add_approximate_options(CLI::App& command, ApproximateOptions& options);

/// `undine approximate`: fields and their derivatives at query points, from points in a file.
int run_approximate(const ApproximateOptions& options);

}  // namespace undine
