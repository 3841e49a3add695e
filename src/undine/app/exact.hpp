#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace undine {

/// What `undine exact` was asked for. Points, times and lengths as written: numbers in SI units, or with a unit.
struct ExactOptions {
  std::string name;
  std::vector<std::string> sets = {};  ///< parameter=value
  std::vector<std::string> at = {};    ///< points, "0.2" or "0.2,0.1"
  std::string from = {}, to = {};      ///< ends of a line of points; empty: the example of the solution
  int points = 0;                      ///< on that line; 0: 101
  std::string time = {};               ///< empty: the time of the example
  std::filesystem::path out = {};      ///< a CSV file; empty: standard output
};

/// The table as CSV: comments that say what it is, a line of `name [unit]`, one line per point. Throws InputError.
std::string exact_table(const ExactOptions& options);

/// Prints the table or writes it to `out`, whole or not at all. Returns the exit code.
int run_exact(const ExactOptions& options);

}  // namespace undine
