#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace undine {

/// What the command line says of a verification.
struct VerifyOptions {
  std::vector<std::string> names;    ///< of study files, or globs of them; none: all that are not long
  std::filesystem::path files = {};  ///< folder of studies; empty: those that come with the program
  std::filesystem::path out = {};    ///< empty: out/verify, of the reduced one out/verify-quick
  int jobs = 0;                      ///< members at a time; 0: as many as there are cores
  bool quick = false, list = false, json = false, again = false;
};

/// Runs the studies that have limits, and prints one table of what was reached beside what is wanted. Returns
/// exit_missed if a limit was missed. Throws InputError.
int run_verify(const VerifyOptions& options);

}  // namespace undine
