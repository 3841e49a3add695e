#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "undine/backend/backend.hpp"
#include "undine/engine/store.hpp"
#include "undine/io/case/document.hpp"
#include "undine/io/checkpoint.hpp"

namespace undine {

/// What must be the same for a checkpoint to fit a case: all keys but those of how long it runs, what it writes and
/// when it gives up. As lines of key=value.
std::string fitting_keys(const Document& document);
/// Their hash.
std::string case_hash(const Document& document);

/// What decides how sums round beside the case: the program's version and the instructions that it runs with.
std::string rounding_of(const Backend& backend);

/// A checkpoint that was found in a folder, and those newer than it that could not be used.
struct FoundCheckpoint {
  OwnedCheckpoint checkpoint;
  std::filesystem::path file;
  std::vector<std::string> refused;  ///< one sentence each, with the reason
  std::string rounding;              ///< of who wrote it
};

/// The last two checkpoints of a folder, by step.
class Checkpoints {
 public:
  /// `keys` as fitting_keys gives them, `hash` theirs: written with each, and asked of each that is read. `rounding` as
  /// rounding_of gives it: written with each.
  Checkpoints(std::filesystem::path folder, std::string keys, std::string hash, std::string rounding)
      : folder_(std::move(folder)), keys_(std::move(keys)), hash_(std::move(hash)), rounding_(std::move(rounding)) {}

  const std::string& hash() const { return hash_; }
  const std::string& rounding() const { return rounding_; }
  /// Writes one and removes all but the last two.
  void write(CheckpointData data) const;
  /// The newest that is whole and of this case. Throws InputError, saying of each why not, where there is none.
  FoundCheckpoint read_newest() const;
  /// Whether a run began in the folder but was ended before its first checkpoint.
  bool began_without() const;
  /// Puts what was refused out of the way, so that it is not counted among the last two: NAME.refused.
  void set_aside_newer_than(const std::filesystem::path& file) const;

 private:
  std::vector<std::filesystem::path> files() const;
  std::string misfit(const OwnedCheckpoint& checkpoint) const;

  std::filesystem::path folder_;
  std::string keys_, hash_, rounding_;
};

/// Says when a checkpoint is due: after so much simulated time, or after so much time on the clock.
class CheckpointClock {
 public:
  CheckpointClock(double simulated, double wall) : simulated_(simulated), wall_(wall) {}
  bool due(double before, double now) const;
  void written() { last_ = std::chrono::steady_clock::now(); }

 private:
  double simulated_, wall_;  ///< s; 0: never
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The particles of a checkpoint in their order, every field.
template <int N>
Store<N> store_from(const OwnedFrame& frame);

}  // namespace undine
