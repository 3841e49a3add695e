#include "undine/io/snapshot.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/core/error.hpp"
#include "undine/io/hdf5_file.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

constexpr std::uint8_t vtk_vertex = 1;
const std::string root = "VTKHDF";
const std::string point_data = "VTKHDF/PointData";

/// Components in the file of a value that has so many in memory: VTK knows vectors of 3 and tensors of 9.
int stored_components(int components, int dimensions) {
  if (dimensions == 2 && components == 2) return 3;
  if (dimensions == 2 && components == 4) return 9;
  return components;
}

/// Where component k of the value goes in the file, or comes from.
std::size_t stored_place(int k, int components, int stored) {
  return static_cast<std::size_t>(stored == 9 && components == 4 ? k / 2 * 3 + k % 2 : k);
}

Hdf5Extent shape(std::size_t particles, int stored) {
  return {particles, stored == 1 ? 0 : static_cast<std::size_t>(stored)};
}

template <class T>
void write_padded(Hdf5File& file, const std::string& name, const Column& column, Hdf5Extent extent, int compression) {
  const int stored = extent.columns == 0 ? 1 : static_cast<int>(extent.columns);
  std::vector<T> values(extent.size(), T(0));
  for (std::size_t i = 0; i < extent.rows; ++i)
    for (int k = 0; k < column.components; ++k)
      values[i * stored + stored_place(k, column.components, stored)] =
          static_cast<T>(column.data[i * column.components + k]);
  file.write<T>(name, std::span<const T>(values), extent, compression);
}

void write_column(Hdf5File& file, const std::string& name, const Column& column, Hdf5Extent extent, Precision precision,
                  int compression) {
  if (precision == Precision::double_precision)
    write_padded<double>(file, name, column, extent, compression);
  else
    write_padded<float>(file, name, column, extent, compression);
  file.write_attribute(name, "unit", column.unit);
  file.write_attribute<std::int64_t>(name, "components", column.components);
}

void write_cells(Hdf5File& file, std::size_t particles) {
  const auto count = static_cast<std::int64_t>(particles);
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"})
    file.write<std::int64_t>(root + "/" + name, {count});
  std::vector<std::int64_t> numbers(particles + 1);
  std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
  const auto all = std::span<const std::int64_t>(numbers);
  constexpr int compression = 1;  // counting numbers shrink to almost nothing
  file.write<std::int64_t>(root + "/Offsets", all, {particles + 1}, compression);
  file.write<std::int64_t>(root + "/Connectivity", all.first(particles), {particles}, compression);
  const std::vector<std::uint8_t> types(particles, vtk_vertex);
  file.write<std::uint8_t>(root + "/Types", std::span<const std::uint8_t>(types), {particles}, compression);
}

void write_header(Hdf5File& file, const Frame& frame) {
  file.create_group(root);
  const std::int64_t version[] = {1, 0};
  file.write_attribute<std::int64_t>(root, "Version", std::span<const std::int64_t>(version));
  file.write_attribute(root, "Type", "UnstructuredGrid");
  file.write_attribute(root, "program", "undine");
  file.write_attribute(root, "program_version", program_version());
  file.write_attribute<double>(root, "time", frame.time);
  file.write_attribute<std::int64_t>(root, "step", frame.step);
  file.write_attribute<std::int64_t>(root, "dimensions", frame.dimensions);
  file.write_attribute(root, "position", frame.position);
  file.create_group(root + "/FieldData");
  file.write<double>(root + "/FieldData/TimeValue", {frame.time});
  file.write<std::int64_t>(root + "/FieldData/Step", {frame.step});
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError({.what = fmt::format("'{}' is not a snapshot of particles", path.string()), .why = why});
}

OwnedColumn read_column(const Hdf5File& file, const std::string& name, const OwnedFrame& frame) {
  const Hdf5Extent extent = file.extent(name);
  if (extent.rows != frame.particles)
    refuse(file.path(), fmt::format("{} has {} rows for {} points", name, extent.rows, frame.particles));
  const std::size_t stored = std::max<std::size_t>(extent.columns, 1);
  OwnedColumn column;
  if (file.has_attribute(name, "unit")) column.unit = file.read_attribute_text(name, "unit");
  auto components = static_cast<std::int64_t>(stored);
  if (file.has_attribute(name, "components")) components = file.read_attribute<std::int64_t>(name, "components");
  if (components < 1 || components > static_cast<std::int64_t>(stored) || stored > 4096)
    refuse(file.path(), fmt::format("{} has {} columns for {} components", name, stored, components));
  column.components = static_cast<int>(components);
  const std::vector<double> values = file.read<double>(name);
  column.data.resize(frame.particles * static_cast<std::size_t>(components));
  for (std::size_t i = 0; i < frame.particles; ++i)
    for (int k = 0; k < column.components; ++k)
      column.data[i * column.components + k] =
          values[i * stored + stored_place(k, column.components, static_cast<int>(stored))];
  return column;
}

OwnedColumn read_points(const Hdf5File& file, const OwnedFrame& frame) {
  OwnedColumn column = read_column(file, root + "/Points", frame);
  column.name = frame.position;
  if (column.components != frame.dimensions)
    refuse(file.path(), fmt::format("Points have {} components in {} dimensions", column.components, frame.dimensions));
  return column;
}

/// Time, step, dimensions and positions; no other columns.
OwnedFrame read_header(const Hdf5File& file) {
  const std::filesystem::path& path = file.path();
  if (!file.has(root) || !file.has_attribute(root, "Type")) refuse(path, "it holds no VTKHDF data");
  if (const std::string type = file.read_attribute_text(root, "Type"); type != "UnstructuredGrid")
    refuse(path, fmt::format("its type is '{}'; expected 'UnstructuredGrid'", type));
  OwnedFrame frame;
  if (file.has_attribute(root, "time")) frame.time = file.read_attribute<double>(root, "time");
  if (file.has_attribute(root, "step")) frame.step = file.read_attribute<std::int64_t>(root, "step");
  if (file.has_attribute(root, "position")) frame.position = file.read_attribute_text(root, "position");
  if (file.has_attribute(root, "dimensions")) {
    const auto dimensions = file.read_attribute<std::int64_t>(root, "dimensions");
    if (dimensions < 1 || dimensions > 3) refuse(path, fmt::format("it has {} dimensions", dimensions));
    frame.dimensions = static_cast<int>(dimensions);
  }
  const Hdf5Extent points = file.extent(root + "/Points");
  if (points.columns != 3) refuse(path, fmt::format("its points have {} coordinates; expected 3", points.columns));
  frame.particles = points.rows;
  const std::vector<std::int64_t> counts = file.read<std::int64_t>(root + "/NumberOfPoints");
  if (std::accumulate(counts.begin(), counts.end(), std::int64_t{0}) != static_cast<std::int64_t>(points.rows))
    refuse(path, fmt::format("NumberOfPoints does not say {}, the number of its points", points.rows));
  frame.columns.push_back(read_points(file, frame));
  return frame;
}

OwnedIntColumn read_integers(const Hdf5File& file, const std::string& name, std::size_t particles, int bytes) {
  OwnedIntColumn column;
  if (bytes > 4)
    column.data = file.read<std::int64_t>(name, {particles, 0});
  else
    column.data = file.read<std::int32_t>(name, {particles, 0});
  return column;
}

}  // namespace

void write_snapshot(const std::filesystem::path& path, const Frame& frame, const SnapshotOptions& options) {
  check(frame);
  AtomicFile target(path);
  Hdf5File file = Hdf5File::create(target.temporary());
  write_header(file, frame);
  write_cells(file, frame.particles);
  file.create_group(point_data);
  for (const Column& column : frame.columns) {
    if (column.name == frame.position) {
      write_column(file, root + "/Points", column, {frame.particles, 3}, options.positions, options.compression);
    } else {
      const Hdf5Extent extent = shape(frame.particles, stored_components(column.components, frame.dimensions));
      write_column(file, point_data + "/" + column.name, column, extent, options.fields, options.compression);
    }
  }
  for (const IntColumn& column : frame.integers) {
    const auto write = [&]<class T>(const T* values) {
      file.write<T>(point_data + "/" + column.name, std::span<const T>(values, frame.particles), {frame.particles},
                    options.compression);
    };
    std::visit(write, column.data);
  }
  file.close();
  target.commit();
}

OwnedFrame read_positions(const std::filesystem::path& path) { return read_header(Hdf5File::open(path)); }

OwnedFrame read_snapshot(const std::filesystem::path& path) {
  const Hdf5File file = Hdf5File::open(path);
  OwnedFrame frame = read_header(file);
  if (!file.has(point_data)) return frame;
  for (const std::string& name : file.names(point_data)) {
    const std::string place = point_data + "/" + name;
    const int type = file.stored_type(place);
    if (type == 0) refuse(path, fmt::format("{} holds neither real nor whole numbers", place));
    if (type > 0) {
      frame.columns.push_back(read_column(file, place, frame));
      frame.columns.back().name = name;
    } else {
      frame.integers.push_back(read_integers(file, place, frame.particles, -type));
      frame.integers.back().name = name;
    }
  }
  return frame;
}

SeriesFile SeriesFile::create(std::filesystem::path path) { return SeriesFile(std::move(path)); }

SeriesFile SeriesFile::resume(std::filesystem::path path, double last_time) {
  SeriesFile series(std::move(path));
  if (!std::filesystem::exists(series.path_)) return series;
  const Json json = read_json(series.path_);
  try {
    for (const Json& entry : json.at("files")) {
      const double time = entry.at("time").get<double>();
      if (time <= last_time) series.entries_.emplace_back(entry.at("name").get<std::string>(), time);
    }
  } catch (const Json::exception& error) {
    throw InputError({.what = "this is not a list of snapshots",
                      .where = {series.path_.string()},
                      .why = error.what(),
                      .fix = "remove the file; the next snapshot starts a new one"});
  }
  return series;
}

void SeriesFile::add(const std::string& file_name, double time) {
  entries_.emplace_back(file_name, time);
  Json files = Json::array();
  for (const auto& [name, at] : entries_) files.push_back({{"name", name}, {"time", at}});
  write_json(path_, Json{{"file-series-version", "1.0"}, {"files", std::move(files)}});
}

}  // namespace undine
