#include "undine/app/gauges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "undine/app/gauges/catalogue.hpp"
#include "undine/app/gauges/column.hpp"
#include "undine/core/nearest.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

template <int N, class... Types>
std::unique_ptr<Gauge<N>> make_gauge(Catalogue<Types...> types, const Table& table, const GaugeContext<N>& context) {
  const std::string type = table.choice("type", types.names());
  std::unique_ptr<Gauge<N>> gauge;
  ((type == Types::info.name ? void(gauge = std::make_unique<Types>(table, context)) : void()), ...);
  return gauge;
}

/// Which multiple of `every` was passed last. A function of the time alone, so that a resumed run samples as an
/// unbroken one.
double due_index(double time, double every) { return std::floor(time / every + 1e-9); }

}  // namespace

std::vector<Info> gauge_infos() {
  std::vector<Info> all;
  for (int k = 0; k < gauges::GaugeTypes<3>::size; ++k) all.push_back(gauges::GaugeTypes<3>::info(k));
  return all;
}

template <int N>
GaugeSet<N>::GaugeSet(const Table& root, const GaugeContext<N>& context) {
  std::set<std::string> names;
  for (const Table& table : root.tables("gauge")) {
    entries_.push_back(read_entry(table, context));
    const std::string& name = entries_.back().name;
    if (!names.insert(name).second)
      table.fail("name", fmt::format("two gauges are called '{}'", name), "each writes the file NAME.csv",
                 "rename one");
  }
}

template <int N>
auto GaugeSet<N>::read_entry(const Table& table, const GaugeContext<N>& context) -> Entry {
  Entry entry{.name = table.text("name"),
              .every = table.positive("every", unit::time, context.interval),
              .gauge = make_gauge(gauges::GaugeTypes<N>{}, table, context),
              .reference = {},
              .path = {},
              .series = {}};
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
  };
  if (entry.name.empty() || entry.name[0] == '.' || !std::ranges::all_of(entry.name, fits))
    table.fail("name", fmt::format("'{}' cannot name a gauge", shortened(entry.name, 40)),
               "it becomes a file name, NAME.csv", "use letters, digits, '_', '-' and '.'");
  const Table reference = table.table("reference");
  if (reference.exists()) entry.reference = read_reference(reference, entry.gauge->columns());
  return entry;
}

template <int N>
auto GaugeSet<N>::read_reference(const Table& table, const std::vector<SeriesColumn>& columns) -> Reference {
  const fs::path file = table.path("file");
  if (!fs::is_regular_file(file))
    table.fail("file", fmt::format("there is no file '{}'", file.string()), {},
               "names are relative to the case file's folder");
  const CsvTable data = read_csv(file);
  const CsvColumn& time = gauges::find_column(table, "time", data, 0);
  const CsvColumn& value = gauges::find_column(table, "value", data, 1);
  std::vector<std::string> names;
  for (const SeriesColumn& column : columns) names.push_back(column.name);
  Reference reference{table.choice("column", names, names.front()), {time.values, value.values}, 0};
  reference.until = table.has("until") ? table.positive("until", unit::time) : std::numeric_limits<double>::infinity();

  const auto check_unit = [&](const CsvColumn& column, const std::string& ours, std::string_view scale) {
    if (!column.unit.empty() && column.unit != ours && !table.has(scale))
      table.fail("file", fmt::format("column '{}' is in {}, not in {}", column.name, column.unit, ours), {},
                 fmt::format("give '{}', the factor from one to the other (1 if they are the same)", scale));
  };
  check_unit(time, "s", "time_scale");
  check_unit(value, std::ranges::find(columns, reference.column, &SeriesColumn::name)->unit, "scale");
  const double scale = table.number("scale", 1.0), shift = table.number("shift", 0.0);
  const double time_scale = table.positive("time_scale", unit::one, 1.0);
  const double time_shift = table.quantity("time_shift", unit::time, 0.0);
  for (double& each : reference.samples.values) each = each * scale + shift;
  for (double& each : reference.samples.times) each = each * time_scale + time_shift;
  if (finite(reference.samples).times.empty())
    table.fail("file", fmt::format("'{}' has no numbers in '{}' and '{}'", file.string(), time.name, value.name));
  return reference;
}

template <int N>
std::vector<SeriesColumn> GaugeSet<N>::file_columns(const Gauge<N>& gauge) {
  std::vector<SeriesColumn> columns{{"time", "s"}};
  for (SeriesColumn& column : gauge.columns()) columns.push_back(std::move(column));
  return columns;
}

template <int N>
void GaugeSet<N>::set_paths(const fs::path& folder) {
  if (entries_.empty()) return;
  std::error_code failure;
  fs::create_directories(folder / "gauges", failure);
  if (failure)
    throw Error(
        {.what = fmt::format("cannot make the folder '{}'", (folder / "gauges").string()), .why = failure.message()});
  for (Entry& entry : entries_) entry.path = folder / "gauges" / (entry.name + ".csv");
  write_references(folder / "gauges" / "reference");
}

template <int N>
void GaugeSet<N>::write_references(const fs::path& folder) const {
  std::error_code failure;
  fs::remove_all(folder, failure);
  for (const Entry& entry : entries_) {
    if (!entry.reference) continue;
    fs::create_directories(folder, failure);
    const auto columns = file_columns(*entry.gauge);
    const auto column = std::ranges::find(columns, entry.reference->column, &SeriesColumn::name);
    TimeSeries file = TimeSeries::create(folder / (entry.name + ".csv"), {columns.front(), *column});
    const Samples compared =
        between(finite(entry.reference->samples), -std::numeric_limits<double>::infinity(), entry.reference->until);
    for (std::size_t k = 0; k < compared.times.size(); ++k) file.add(std::array{compared.times[k], compared.values[k]});
  }
}

template <int N>
void GaugeSet<N>::create(const fs::path& folder) {
  set_paths(folder);
  for (Entry& entry : entries_) {
    entry.series = TimeSeries::create(entry.path, file_columns(*entry.gauge));
    entry.last = -1;
  }
}

template <int N>
void GaugeSet<N>::resume(const fs::path& folder, double last_time) {
  set_paths(folder);
  for (Entry& entry : entries_) {
    entry.series = TimeSeries::resume(entry.path, file_columns(*entry.gauge), last_time);
    const CsvTable kept = read_csv(entry.path);
    entry.last = kept.rows == 0 ? -1 : due_index(kept.columns[0].values.back(), entry.every);
  }
}

template <int N>
void GaugeSet<N>::sample(Flow<N>& flow) {
  const double time = flow.time();
  bool forces_known = false;
  for (Entry& entry : entries_) {
    const double due = due_index(time, entry.every);
    if (!(due > entry.last)) continue;
    if (!entry.series) throw Error({.what = "gauges were sampled before they had a folder to write to"});
    if (entry.gauge->needs_wall_forces() && !forces_known) {
      flow.evaluate_wall_forces();
      forces_known = true;
    }
    std::vector<double> row{time};
    for (const double value : entry.gauge->read(flow)) row.push_back(value);
    entry.series->add(row);
    entry.last = due;
  }
}

template <int N>
std::vector<Comparison> GaugeSet<N>::compare() const {
  std::vector<Comparison> all;
  for (const Entry& entry : entries_) {
    if (!entry.reference || !entry.series) continue;
    const CsvTable file = read_csv(entry.path);
    const CsvColumn& column = file.column(entry.reference->column);
    all.push_back(
        undine::compare({file.columns[0].values, column.values}, entry.reference->samples, entry.reference->until));
    all.back().gauge = entry.name;
    all.back().column = column.name;
    all.back().unit = column.unit;
  }
  return all;
}

template class GaugeSet<1>;
template class GaugeSet<2>;
template class GaugeSet<3>;

}  // namespace undine
