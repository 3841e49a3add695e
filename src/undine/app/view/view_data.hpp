#pragma once
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

#include "undine/app/run/folder.hpp"

namespace undine {

/// What `undine view` answers with, as JSON texts read afresh from the run's files. Numbers are in `blocks` and
/// `texts`, as in a report. Writes nothing but wishes. For any number of threads.
class ViewData {
 public:
  /// Throws InputError where the folder holds no run.
  explicit ViewData(std::filesystem::path folder);

  /// The run with all series; of the particles only what there is.
  std::string all() const;
  /// What changes while a run goes on: status, times of snapshots, progress, and whether the page may control it.
  std::string state(bool may_control) const;
  /// The particles at one time, about `most` of them at most. Throws InputError where there is no such time.
  std::string frame(std::size_t number, std::size_t most) const;
  /// Tells the run what somebody wishes. False where no run listens. Throws Error.
  bool send(std::string_view wish) const;

 private:
  const OwnedFrame& read(const RunFolder& run, std::size_t number) const;
  Json header(const RunFolder& run) const;

  std::filesystem::path folder_;
  mutable std::mutex reading_;      ///< for what follows; and HDF5 is for one thread at a time
  mutable OwnedFrame kept_;         ///< the snapshot that was read last, so that showing more of it reads nothing
  mutable StoredTime kept_stored_;  ///< where it is from
  mutable Json header_;             ///< of the particles, as it was first; null before
};

}  // namespace undine
