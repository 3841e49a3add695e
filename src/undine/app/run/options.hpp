#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace undine {

enum class Verbosity { normal, quiet, json };

/// What the command line says of a run.
struct RunOptions {
  std::filesystem::path file;
  std::vector<std::string> sets;  ///< "key=value" overrides
  std::filesystem::path out;      ///< empty: [output] folder, or out/NAME
  int threads = 0;                ///< 0: as many as there are cores
  bool resume = false;
  bool overwrite = false;
  bool control = false;  ///< whether others may pause and stop it
  bool report = true;    ///< whether a page that shows the run is written at its end, if the case wants one
  Verbosity verbosity = Verbosity::normal;
};

/// Exit codes of the program.
enum ExitCode : int {
  exit_ok = 0,
  exit_internal = 1,
  exit_input = 2,
  exit_run = 3,
  exit_output = 4,
  exit_missed = 5,  ///< verified, and a limit was missed
  exit_interrupted = 130
};

/// Reads and checks a case with everything it names; prints what it resolved. Throws InputError.
int check_case(const RunOptions& options);

/// Runs a case. Throws InputError before anything is written, RunError when the run goes bad.
int run_case(const RunOptions& options);

}  // namespace undine
