#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace undine {

/// What the command line says of a study.
struct StudyOptions {
  std::filesystem::path file;
  std::filesystem::path out;      ///< empty: out/NAME of the study's file
  std::vector<std::string> sets;  ///< "key=value" for every member, after all else
  std::string only;               ///< a glob of member names; empty: all
  int jobs = 0;                   ///< members at a time; 0: as many as there are cores
  bool quick = false;             ///< the reduced study of [quick]
  bool dry_run = false;           ///< say what would run
  bool again = false;             ///< also run members that are finished
  bool json = false;              ///< progress as one JSON object per line
  std::string maker = {};         ///< what results depend on besides the case, such as the build; others are run again
};

/// Runs the members of a study file that are not finished, each as a run of this program, and writes their table.
/// Returns the exit code: ok also when members failed, which are rows. Throws InputError where the file is wrong.
int run_study(const StudyOptions& options);

}  // namespace undine
