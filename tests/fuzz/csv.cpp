// Tables of comma-separated values: particle lists, references of gauges, and time series that a resumed run goes on
// with.
#include <vector>

#include "fuzz/fuzz.hpp"
#include "undine/geometry/points.hpp"
#include "undine/io/time_series.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace undine;
  using namespace undine::fuzz;
  const auto path = folder().file("table.csv", text_of(data, size));
  for (int dimensions = 1; dimensions <= 3; ++dimensions)
    accepted([&] {
      const auto list = load_points_csv(path.string(), dimensions);
      for (const auto& column : list.columns) require(column.size() == list.points.size());
    });
  accepted([&] {
    const auto table = read_csv(path);
    std::vector<SeriesColumn> columns;
    for (const auto& column : table.columns) {
      require(column.values.size() == table.rows);
      columns.push_back({column.name, column.unit});
    }
    constexpr double last = 0.5;
    TimeSeries::resume(path, columns, last);
    const auto kept = read_csv(path);
    for (const double time : kept.columns[0].values) require(time <= last);
  });
  return 0;
}
