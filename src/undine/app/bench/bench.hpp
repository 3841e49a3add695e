#pragma once
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace undine {

/// What `undine bench` times: every combination of the lists. An empty list stands for its default.
struct BenchOptions {
  std::vector<int> particles;           ///< 100000 and 1000000; the splash at 100000 only
  std::vector<int> neighbours;          ///< 74 and 174
  std::vector<int> threads;             ///< one and all cores
  std::vector<std::string> precisions;  ///< mixed and double
  std::vector<std::string> states;      ///< block and splash
  int repeats = 0;                      ///< 0: 5, or 3 where quick
  bool quick = false;
  bool json = false;
};

void add_bench_options(CLI::App& command, BenchOptions& options);

/// Times the force pass and whole steps from the same start, several times over, and prints medians: a table, or with
/// `json` an array of objects that bench/compare reads. docs/performance.md says what the figures mean.
int run_bench(const BenchOptions& options);

}  // namespace undine
