#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "undine/core/catalogue.hpp"
#include "undine/io/case/table.hpp"
#include "undine/io/time_series.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {

/// What gauges must know of the case besides their own table.
template <int N>
struct GaugeContext {
  double spacing = 0;   ///< of the particles, m
  double interval = 0;  ///< time between samples where a gauge does not say, s
  Vec<N> gravity{};     ///< m/s^2
  Domain<N> domain = Domain<N>::unbounded();
  std::map<std::string, int> bodies = {};  ///< numbers of the walls that have a name
  std::vector<int> body_of_id =
      {};  ///< body of each particle, by particle id; may be empty for a check of the case alone
};

/// One instrument: it reads the run and changes nothing.
template <int N>
class Gauge {
 public:
  virtual ~Gauge() = default;
  /// What `read` gives, without the time.
  virtual std::vector<SeriesColumn> columns() const = 0;
  /// One value per column, in SI units; NaN where there is nothing to measure.
  virtual std::vector<double> read(const WeaklyCompressible<N>& flow) const = 0;
  /// Whether field acc of the walls must hold the forces from the fluid before `read`.
  virtual bool needs_wall_forces() const { return false; }
};

/// Numbers over time, ascending (s); values may be NaN.
struct Samples {
  std::vector<double> times, values;
};

/// How a gauge's column agrees with published data, over the times that both cover. NaN where there is no such time.
struct Comparison {
  std::string gauge = {}, column = {}, unit = {};
  double rms = 0;                  ///< of ours (linear between samples) minus the reference, at the reference's times
  double range = 0;                ///< max - min of the reference
  double relative = 0;             ///< rms / range
  double peak = 0, peak_time = 0;  ///< largest of our samples; s
  double reference_peak = 0, reference_peak_time = 0;  ///< largest of the reference's; s
  std::size_t points = 0;                              ///< of the reference that were compared
};

/// Compares two series up to the time `until` (s). Values that are not finite do not count.
Comparison compare(const Samples& ours, const Samples& reference, double until);

/// The comparisons as aligned lines under a header; empty if there are none.
std::string comparison_table(std::span<const Comparison> comparisons);

/// The gauge types that a case file can name, for `undine list gauges`.
std::vector<Info> gauge_infos();

/// The gauges of a case file's [[gauge]] tables, each with its file DIR/gauges/NAME.csv.
template <int N>
class GaugeSet {
 public:
  /// Reads and checks the tables and their reference data; writes nothing. Throws InputError.
  GaugeSet(const Table& root, const GaugeContext<N>& context);

  /// Starts new files, and leaves the reference data beside them. Throws Error.
  void create(const std::filesystem::path& folder);
  /// Goes on with the files of an earlier run, without their rows later than last_time (s). Throws Error, InputError.
  void resume(const std::filesystem::path& folder, double last_time);

  /// Writes a row for each gauge that is due: at the first time at or after each multiple of its `every`, 0 included.
  /// Call it after each step. Throws Error, and InputError if a gauge cannot work in this run.
  void sample(WeaklyCompressible<N>& flow);

  /// Compares what the files hold with the reference data of those gauges that have some.
  std::vector<Comparison> compare() const;

  std::size_t size() const { return entries_.size(); }

 private:
  struct Reference {
    std::string column;
    Samples samples;
    double until;
  };
  struct Entry {
    std::string name;
    double every;
    std::unique_ptr<Gauge<N>> gauge;
    std::optional<Reference> reference;
    std::filesystem::path path;
    std::optional<TimeSeries> series;
    double last = -1;  ///< index of the due time that the last row of the file served
  };

  static Entry read_entry(const Table& table, const GaugeContext<N>& context);
  static Reference read_reference(const Table& table, const std::vector<SeriesColumn>& columns);
  static std::vector<SeriesColumn> file_columns(const Gauge<N>& gauge);
  void set_paths(const std::filesystem::path& folder);
  /// DIR/gauges/reference/NAME.csv: the published data as they are compared, so that the folder shows them by itself.
  void write_references(const std::filesystem::path& folder) const;

  std::vector<Entry> entries_;
};

extern template class GaugeSet<1>;
extern template class GaugeSet<2>;
extern template class GaugeSet<3>;

}  // namespace undine
