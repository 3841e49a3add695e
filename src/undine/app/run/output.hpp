#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "undine/app/run/options.hpp"
#include "undine/io/case/document.hpp"
#include "undine/io/snapshot.hpp"
#include "undine/io/time_series.hpp"
#include "undine/schemes/flow.hpp"

namespace undine {

/// What [output] says. Intervals in s; 0: never.
struct OutputPlan {
  std::filesystem::path folder;
  double snapshots = 0, energies = 0, checkpoints = 0;
  std::vector<double> at;           ///< further times of snapshots
  double checkpoint_wall_time = 0;  ///< on the clock, not in the simulation
  std::vector<int> fields;          ///< of snapshots, as in fields.def
  bool report = true;               ///< whether a page that shows the run is written at its end
};

/// Reads [output] for a run that ends at `end` (s).
OutputPlan read_output(const Table& root, const RunOptions& options, double end);

/// Whether a multiple of `interval` lies in (before, now]; also at the very start.
bool due(double interval, double before, double now);

/// The file of the snapshot that is due for the times in (before, now]; empty if none is.
std::string snapshot_due(const OutputPlan& plan, double before, double now);

/// The particles as a frame; `group` must live as long as the frame. All fields in use when `fields` is empty.
template <int N>
Frame frame_of(const Flow<N>& flow, std::int64_t step, const std::vector<int>& fields,
               std::vector<std::int32_t>& groups);

/// The columns of energies.csv.
std::vector<SeriesColumn> energy_columns();

/// The energies of a run as a series, with the residual of the audit.
template <int N>
class EnergySeries {
 public:
  /// Starts the file, or goes on with it after `last_time` (s).
  EnergySeries(const std::filesystem::path& folder, bool resume, double last_time);
  void add(const Flow<N>& flow, const Step& step, std::int64_t count);
  void set_start(double total, double potential);
  double start_total() const { return start_total_; }
  double start_potential() const { return start_potential_; }
  /// Residual of the audit relative to the scale: initial potential energy, or the largest energy seen where there is
  /// none.
  double relative_residual(const Energies& e) const;

 private:
  TimeSeries series_;
  double start_total_ = 0, start_potential_ = 0;
};

/// What may limit a step, in the order of the numbers in steps.csv.
inline constexpr std::array<std::string_view, 6> step_limiters{"fixed",   "courant", "force",
                                                               "viscous", "largest", "tolerance"};

/// The steps of a run as a series, steps.csv: their size, what limited it, and how many particles there were.
class StepSeries {
 public:
  /// Starts the file, or goes on with it after `last_time` (s).
  StepSeries(const std::filesystem::path& folder, bool resume, double last_time);
  void add(double time, std::int64_t count, const Step& step, std::size_t fluid, std::size_t wall);

 private:
  TimeSeries series_;
};

/// Replaces progress.json, by which others may follow a run. Not forced to the disk, and silent where it cannot be
/// written: nothing depends on it.
void write_progress(const std::filesystem::path& folder, const std::string& text);

}  // namespace undine
