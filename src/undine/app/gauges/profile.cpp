#include "undine/app/gauges/profile.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "undine/app/gauges/column.hpp"
#include "undine/core/nearest.hpp"
#include "undine/engine/corrected_interpolation.hpp"

namespace undine::gauges {
template <int N>
Profile<N>::Profile(const Table& table, const GaugeContext<N>& context)
    : from_(read_point<N>(table, "from")),
      to_(read_point<N>(table, "to")),
      component_(
          static_cast<int>(std::ranges::find(axes<N>(), table.choice("component", axes<N>())) - axes<N>().begin())) {
  for (const auto& [key, end] : {std::pair("from", from_), std::pair("to", to_)})
    if (!context.domain.contains(end))
      table.fail(key, "the line leaves the domain", "no particle can come there", "move its end, or widen [domain]");
  if (norm_sq(to_ - from_) == 0) table.fail("to", "the line has no length", {}, "let 'to' differ from 'from'");
  read_profile(table);
}

template <int N>
void Profile<N>::read_profile(const Table& table) {
  const std::filesystem::path file = table.path("file");
  if (!std::filesystem::is_regular_file(file))
    table.fail("file", fmt::format("there is no file '{}'", file.string()), {},
               "names are relative to the case file's folder");
  const CsvTable data = read_csv(file);
  const std::vector<double>& place = find_column(table, "place", data).values;
  const std::vector<double>& value = find_column(table, "value", data).values;
  const double length = table.positive("length", unit::one, 1.0), scale = table.number("scale", 1.0);
  const std::vector<bool> chosen = chosen_rows(table, data);
  for (std::size_t k = 0; k < data.rows; ++k) {
    if (!chosen[k] || !std::isfinite(place[k]) || !std::isfinite(value[k])) continue;
    const double share = place[k] / length;
    if (share < 0 || share > 1)
      table.fail("length", fmt::format("the place {} of '{}' is off the line", place[k], file.string()),
                 fmt::format("places go from 0 at 'from' to {} at 'to'", length),
                 "give 'length', the place at the end of the line");
    points_.push_back({share, value[k] * scale});
  }
  if (points_.empty())
    table.fail("file", fmt::format("'{}' has no such numbers", file.string()),
               "no row has what 'where' asks for, or "
               "'place' and 'value' are empty there");
  std::ranges::sort(points_, {}, &Point::share);
}

template <int N>
std::vector<bool> Profile<N>::chosen_rows(const Table& table, const CsvTable& data) const {
  std::vector<bool> chosen(data.rows, true);
  const Table where = table.table("where");
  for (const std::string& key : where.keys()) {
    const double wanted = where.number(key);
    const CsvColumn* const column = data.find(key);
    if (!column) where.fail(key, fmt::format("'{}' has no column '{}'", data.path.string(), shortened(key, 40)));
    for (std::size_t k = 0; k < data.rows; ++k) chosen[k] = chosen[k] && column->values[k] == wanted;
  }
  return chosen;
}

template <int N>
std::vector<SeriesColumn> Profile<N>::columns() const {
  std::vector<SeriesColumn> all{{"L2", "m/s"}, {"L2_relative"}, {"Linf", "m/s"}};
  for (const Point& point : points_) all.push_back({fmt::format("at_{:g}", point.share), "m/s"});
  return all;
}

template <int N>
std::vector<double> Profile<N>::read(const Flow<N>& flow) const {
  const InterpolationSource<N> source = flow.interpolation_source();
  double error = 0, size = 0, largest = 0;
  std::vector<double> row{0, 0, 0};
  for (const Point& point : points_) {
    const CorrectedFluid<N> fluid = interpolate_corrected(source, from_ + point.share * (to_ - from_));
    const double found = fluid.weight > 0 ? fluid.v[component_] : nan;
    error += sq(found - point.value);
    size += sq(point.value);
    largest = std::max(largest, std::abs(found - point.value));
    row.push_back(found);
  }
  row[0] = std::sqrt(error / static_cast<double>(points_.size()));
  row[1] = size > 0 ? std::sqrt(error / size) : nan;
  row[2] = std::isfinite(error) ? largest : nan;
  return row;
}

template class Profile<1>;
template class Profile<2>;
template class Profile<3>;

}  // namespace undine::gauges
