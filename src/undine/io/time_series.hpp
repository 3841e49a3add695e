#pragma once
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace undine {

struct SeriesColumn {
  std::string name;
  std::string unit = {};  ///< such as "m/s"; empty: dimensionless
};

/// Writes numbers over time to a CSV file: comments that start with '#', a line of `name [unit]`, then one line per
/// row, flushed at once. Numbers are the shortest text that reads back as the same double. The first column is time, in
/// s.
class TimeSeries {
 public:
  /// Starts a new file, replacing an older one. Throws Error.
  static TimeSeries create(const std::filesystem::path& path, std::vector<SeriesColumn> columns,
                           const std::vector<std::string>& comments = {});
  /// Goes on with a file of the same columns: rows later than `last_time`, and a row that was cut short, are dropped.
  /// Starts a new file if there is none. Throws InputError if the columns differ.
  static TimeSeries resume(const std::filesystem::path& path, std::vector<SeriesColumn> columns, double last_time,
                           const std::vector<std::string>& comments = {});

  /// Adds a row: the time, then one value per further column. Throws Error (such as a full disk).
  void add(std::span<const double> row);

 private:
  TimeSeries(std::filesystem::path path, std::size_t width);

  std::filesystem::path path_;
  std::size_t width_ = 0;
  std::ofstream stream_;
};

struct CsvColumn {
  std::string name;
  std::string unit;
  std::vector<double> values;  ///< NaN where a cell is empty
};

/// What a CSV file holds; every column has `rows` values.
struct CsvTable {
  std::filesystem::path path;
  std::size_t rows = 0;
  std::vector<CsvColumn> columns;

  /// The column of that name (without its unit), or nullptr.
  const CsvColumn* find(std::string_view name) const;
  /// The same; throws InputError, naming the columns that there are.
  const CsvColumn& column(std::string_view name) const;
};

/// Reads comma-separated numbers: empty lines and what follows '#' at the start of a line are skipped, the first other
/// line names the columns (`name` or `name [unit]`), empty cells and "nan" are NaN. Throws InputError with the line and
/// the column.
CsvTable read_csv(const std::filesystem::path& path);
/// The same from text; `name` stands for the file in errors.
CsvTable parse_csv(const std::string& text, const std::filesystem::path& name);

}  // namespace undine
