#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "undine/io/frame.hpp"

namespace undine {

enum class Precision { single_precision, double_precision };

struct SnapshotOptions {
  Precision positions = Precision::double_precision;
  Precision fields = Precision::single_precision;
  int compression = 1;  ///< 0 none, 1 (fast) to 9 (small)
};

/// Writes one time of a run as a VTKHDF file ("UnstructuredGrid" of single points), which ParaView and VTK 9.1 or later
/// open. Vectors have three components in the file, and 2x2 tensors nine, padded by zeros; what they had, units, time,
/// step and the program's version are attributes. The file appears whole or not at all, and equal frames give equal
/// bytes. Throws Error.
void write_snapshot(const std::filesystem::path& path, const Frame& frame, const SnapshotOptions& options = {});

/// Reads what write_snapshot wrote, or any VTKHDF points of another program. Throws InputError.
OwnedFrame read_snapshot(const std::filesystem::path& path);
/// The same with the positions and no other columns.
OwnedFrame read_positions(const std::filesystem::path& path);

/// The list "NAME.vtkhdf.series" of the snapshots of a run with their times, which ParaView opens as an animation.
class SeriesFile {
 public:
  /// Starts an empty list; nothing is written before the first add().
  static SeriesFile create(std::filesystem::path path);
  /// Goes on with the list at `path`, without the snapshots later than `last_time`; an empty list if there is no such
  /// file. Throws InputError if it is damaged.
  static SeriesFile resume(std::filesystem::path path, double last_time);

  /// Adds a snapshot, named relative to the list's folder, and replaces the file, whole or not at all. Throws Error.
  void add(const std::string& file_name, double time);
  std::size_t size() const { return entries_.size(); }

 private:
  explicit SeriesFile(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
  std::vector<std::pair<std::string, double>> entries_;
};

}  // namespace undine
