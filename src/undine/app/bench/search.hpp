#pragma once
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace undine {

/// What `undine bench search` times. An empty list stands for its default.
struct BenchSearchOptions {
  std::vector<int> particles;         ///< powers of two from 8000 up to a million
  std::vector<std::string> searches;  ///< all of them
  std::vector<std::string> sets;      ///< uniform and clustered
  int repeats = 0;                    ///< 0: 5, or 3 where quick
  bool quick = false;
  bool json = false;
};

/// The subcommand `search` of the bench.
CLI::App* add_bench_search(CLI::App& bench, BenchSearchOptions& options);

/// Times building and asking every search on one thread, and prints how that grows with the number of points: tables,
/// or with `json` an array of objects. docs/search.md says what the figures mean.
int run_bench_search(const BenchSearchOptions& options);

}  // namespace undine
