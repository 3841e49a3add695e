#include "undine/app/report/run_data.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "undine/app/gauges.hpp"
#include "undine/app/report/particles.hpp"
#include "undine/app/run/output.hpp"
#include "undine/core/error.hpp"
#include "undine/io/time_series.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

Json columns_json(const CsvTable& table, Blocks& blocks) {
  Json columns = Json::array();
  for (const CsvColumn& column : table.columns)
    columns.push_back(
        {{"name", column.name}, {"unit", column.unit}, {"block", blocks.add(column.values, 1, BlockType::real64)}});
  return columns;
}

Json series_json(const fs::path& file, Blocks& blocks) {
  return fs::is_regular_file(file) ? columns_json(read_csv(file), blocks) : Json::array();
}

/// The published data that a run left beside its gauge, and how far the gauge is from it.
Json reference_json(const CsvTable& gauge, const fs::path& file, Blocks& blocks) {
  const CsvTable data = read_csv(file);
  if (data.columns.size() < 2)
    throw InputError({.what = "reference data have a time and a value", .where = {file.string()}});
  const CsvColumn &times = data.columns[0], &values = data.columns[1];
  const Samples ours{gauge.columns[0].values, gauge.column(values.name).values};
  const Comparison c = compare(ours, {times.values, values.values}, std::numeric_limits<double>::infinity());
  return {{"column", values.name},
          {"times", blocks.add(times.values, 1, BlockType::real64)},
          {"values", blocks.add(values.values, 1, BlockType::real64)},
          {"points", c.points},
          {"rms", c.rms},
          {"relative", c.relative},
          {"peak", c.peak},
          {"peak_time", c.peak_time},
          {"reference_peak", c.reference_peak},
          {"reference_peak_time", c.reference_peak_time}};
}

Json gauges_json(const fs::path& folder, Blocks& blocks) {
  std::vector<fs::path> files;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().extension() == ".csv") files.push_back(entry.path());
  std::ranges::sort(files);
  Json gauges = Json::array();
  for (const fs::path& file : files) {
    const CsvTable table = read_csv(file);
    Json gauge{{"name", file.stem().string()}, {"columns", columns_json(table, blocks)}};
    const fs::path reference = folder / "reference" / file.filename();
    if (fs::is_regular_file(reference)) gauge["reference"] = reference_json(table, reference, blocks);
    gauges.push_back(std::move(gauge));
  }
  return gauges;
}

}  // namespace

Json run_series(const RunFolder& run, Blocks& blocks) {
  return {{"kind", "run"},
          {"title", run.title()},
          {"run", run.record},
          {"energies", series_json(run.folder / "energies.csv", blocks)},
          {"steps", series_json(run.folder / "steps.csv", blocks)},
          {"limiters", step_limiters},
          {"gauges", gauges_json(run.folder / "gauges", blocks)}};
}

Json run_data(const RunFolder& run, std::size_t bytes, Blocks& blocks) {
  std::vector<std::string> notes;
  Json data = run_series(run, blocks);
  const std::size_t used = blocks.bytes() + data.dump(-1, ' ', false, Json::error_handler_t::replace).size();
  data["particles"] = particles_of(run, bytes > used ? bytes - used : 0, blocks, notes);
  data["notes"] = notes;
  return data;
}

}  // namespace undine
