#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "undine/io/frame.hpp"
#include "undine/io/run_record.hpp"

namespace undine {

/// A snapshot of a run, by its file.
struct StoredTime {
  std::filesystem::path file;
  double time = 0;  ///< s
};

/// What a run left in its folder, for those who look at it.
struct RunFolder {
  std::filesystem::path folder;
  Json record;                     ///< run.json
  std::vector<StoredTime> frames;  ///< in order of time; empty if the run wrote no snapshots

  /// Throws InputError where the folder holds no run, or its lists are damaged.
  static RunFolder open(const std::filesystem::path& folder);

  /// The case's title, or the name of its file.
  std::string title() const;
  /// The case's spacing (m), or the size of the first fluid particle by its mass and density.
  double spacing(const OwnedFrame& frame) const;
  /// The most layers of particles that a wall of the case has.
  int wall_layers() const;
  /// The value of a key of the case as it was resolved.
  std::optional<std::string> resolved(const std::string& key) const;
  /// Index of the snapshot nearest to a time (s). Throws InputError where there are none.
  std::size_t nearest(double time) const;
};

/// A field of a snapshot as one number per particle.
struct ScalarChoice {
  std::string field;
  int part = 0;  ///< 0: the value, or the magnitude of a vector; k: its component k, counted from 1
};

/// "p", "pressure", "v", "speed", "v_x", ... Throws InputError naming what the snapshot has.
ScalarChoice find_scalar(const OwnedFrame& frame, const std::string& name);

/// Name of the choice as it is printed: "|v|", "v_x", "p".
std::string scalar_label(const ScalarChoice& choice, int components);

/// One number per particle.
std::vector<double> scalar_values(const OwnedColumn& column, int part);

/// Of the finite values of the fluid; `inner` without the lowest and the highest hundredth. Infinite, the wrong way
/// round, where there are none.
struct FluidRange {
  double low, high, inner_low, inner_high;
};
FluidRange fluid_range(const std::vector<double>& values, const std::vector<char>& walls);

/// 1 for wall particles, 0 for others.
std::vector<char> walls_of(const OwnedFrame& frame);

/// What fields.def says a field means; empty where it does not know it.
std::string field_meaning(const std::string& name);

}  // namespace undine
