#pragma once
#include <CLI/CLI.hpp>

namespace undine {

/// What `undine bench` times.
struct BenchOptions {
  int particles = 100000;
  int repeats = 5;
  int threads = 0;
  bool json = false;
};

void add_bench_options(CLI::App& command, BenchOptions& options);

/// Times whole steps and sweeps on a rotated, jittered block of fluid and prints rates; medians over the repeats.
int run_bench(const BenchOptions& options);

}  // namespace undine
