#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "undine/app/gauges/comparison.hpp"
#include "undine/app/gauges/gauge.hpp"

namespace undine {

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
  void sample(Flow<N>& flow);

  /// Compares what the files hold with the reference data of those gauges that have some.
  std::vector<Comparison> compare() const;

  std::size_t size() const { return entries_.size(); }
  /// Name of each gauge, and the columns of its file, time included.
  std::vector<std::pair<std::string, std::vector<SeriesColumn>>> files() const {
    std::vector<std::pair<std::string, std::vector<SeriesColumn>>> all;
    for (const Entry& entry : entries_) all.emplace_back(entry.name, file_columns(*entry.gauge));
    return all;
  }

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
