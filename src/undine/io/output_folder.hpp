#pragma once
#include <filesystem>

namespace undine {

enum class FolderMode {
  fresh,     ///< the folder must be new or empty
  resume,    ///< it must exist; all that it holds stays
  overwrite  ///< may hold an earlier run, whose snapshots, lists of snapshots, checkpoints and report are removed
};

/// Makes the folder (with its parents) ready for a run, and tries to write to it. A prepared folder holds the small
/// file `.undine`, without which `overwrite` touches nothing. Throws InputError, naming the folder and the remedy: it
/// is not empty, is a file, cannot be written, or has nothing to resume.
void prepare_output_folder(const std::filesystem::path& folder, FolderMode mode);

}  // namespace undine
