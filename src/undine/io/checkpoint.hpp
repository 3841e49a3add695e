#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "undine/io/frame.hpp"

namespace undine {

/// What a run must remember besides its particles, by name: step counters, accumulated sums, a case's text and hash.
struct CheckpointState {
  std::map<std::string, double> reals = {};
  std::map<std::string, std::int64_t> integers = {};
  std::map<std::string, std::vector<double>> lists = {};
  std::map<std::string, std::string> texts = {};  ///< without zero bytes

  bool operator==(const CheckpointState&) const = default;
};

struct CheckpointData {
  Frame frame;
  CheckpointState state = {};
};

struct OwnedCheckpoint {
  OwnedFrame frame;
  CheckpointState state = {};
};

/// Writes all that a run needs to go on bitwise as if it had not stopped. An older checkpoint of that name stays until
/// the new one is whole and on the disk. Throws Error.
///
/// Format 1: an HDF5 file behind a 512-byte block of text that holds its size and its XXH64, so that a damaged file is
/// never handed to HDF5. Groups: frame, columns, integers, state/{reals,integers,lists,texts}.
void write_checkpoint(const std::filesystem::path& path, const CheckpointData& data);

/// Throws InputError if the file is missing, cut short, changed in any byte, or of a format that this version does not
/// know.
OwnedCheckpoint read_checkpoint(const std::filesystem::path& path);

/// Whether a file starts as a checkpoint does, whole or not; false if it cannot be read.
bool is_checkpoint(const std::filesystem::path& path);

}  // namespace undine
