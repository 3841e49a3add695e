#include "undine/app/approximate/files.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/geometry/points.hpp"
#include "undine/io/atomic_file.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

/// How many of x, y, z the header of a CSV file names without a gap; 1 if none, so that the reader says what is
/// missing.
int dimensions_of_csv(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line))
    if (const auto begin = line.find_first_not_of(" \t\r"); begin != line.npos && line[begin] != '#') break;
  std::string words;  // ",x,y,u,"
  for (const char c : "," + line + ",")
    if (!std::isspace(static_cast<unsigned char>(c))) words += c;
  const auto has = [&](const char* name) { return words.find(name) != words.npos; };
  return has(",z,") ? 3 : has(",y,") ? 2 : 1;
}

OwnedFrame read_csv_points(const fs::path& file) {
  OwnedFrame frame;
  frame.dimensions = dimensions_of_csv(file);
  auto table = load_points_csv(file.string(), frame.dimensions);
  frame.particles = table.points.size();
  OwnedColumn x{frame.position, "m", frame.dimensions, {}};
  for (const Vec3& p : table.points)
    for (int k = 0; k < frame.dimensions; ++k) x.data.push_back(p[k]);
  frame.columns.push_back(std::move(x));
  for (std::size_t k = 0; k < table.names.size(); ++k)
    frame.columns.push_back({table.names[k], "", 1, std::move(table.columns[k])});
  return frame;
}

/// "1/m", "Pa/m^2"; empty where the field has no unit, so that it says nothing wrong of a CSV column.
std::string per_length(const std::string& unit, int power) {
  if (unit.empty()) return unit;
  const std::string metres = power == 1 ? "m" : fmt::format("m^{}", power);
  return unit.find('/') == unit.npos ? unit + "/" + metres : fmt::format("({})/{}", unit, metres);
}

/// Names of the components of a field: u; vx, vy, vz; or stress0, stress1, ...
std::vector<std::string> component_names(const std::string& name, int components, int dimensions) {
  std::vector<std::string> names;
  for (int k = 0; k < components; ++k)
    names.push_back(components == 1 ? name : components == dimensions ? name + "xyz"[k] : fmt::format("{}{}", name, k));
  return names;
}

/// The names of a result's column in a CSV file: du_dx, d2u_dxdy, laplacian_u.
std::vector<std::string> csv_names(const OwnedColumn& column, int N) {
  const auto rest = [&](std::string_view prefix) { return column.name.substr(prefix.size()); };
  std::vector<std::string> names;
  if (column.name == "x") {
    for (int k = 0; k < N; ++k) names.emplace_back(1, "xyz"[k]);
  } else if (column.name.starts_with("grad_") && column.components % N == 0) {
    for (const auto& u : component_names(rest("grad_"), column.components / N, N))
      for (int a = 0; a < N; ++a) names.push_back(fmt::format("d{}_d{}", u, "xyz"[a]));
  } else if (column.name.starts_with("hessian_") && column.components % (N * N) == 0) {
    for (const auto& u : component_names(rest("hessian_"), column.components / (N * N), N))
      for (int ab = 0; ab < N * N; ++ab) names.push_back(fmt::format("d2{}_d{}d{}", u, "xyz"[ab / N], "xyz"[ab % N]));
  } else {
    names = component_names(column.name, column.components, N);
  }
  return names;
}

std::vector<std::string> write_csv(const fs::path& file, const OwnedFrame& result,
                                   const std::vector<std::string>& comments) {
  std::vector<std::string> names;
  for (const auto& column : result.columns)
    for (auto& name : csv_names(column, result.dimensions)) names.push_back(std::move(name));
  for (const auto& column : result.integers) names.push_back(column.name);
  std::string text;
  for (const auto& comment : comments) text += "# " + comment + "\n";
  text += fmt::format("{}\n", fmt::join(names, ","));
  for (std::size_t i = 0; i < result.particles; ++i) {
    const char* comma = "";
    for (const auto& column : result.columns)
      for (int k = 0; k < column.components; ++k) {
        text += fmt::format("{}{}", comma, column.data[i * static_cast<std::size_t>(column.components) + k]);
        comma = ",";
      }
    for (const auto& column : result.integers) text += fmt::format(",{}", column.at(i));
    text += '\n';
  }
  write_text_atomically(file, text);
  return names;
}

}  // namespace

OwnedFrame read_scattered(const fs::path& file) {
  std::error_code failure;
  if (!fs::is_regular_file(file, failure))
    throw InputError({.what = fmt::format("there is no file '{}'", file.string()), .fix = "check the path"});
  return file.extension() == ".csv" ? read_csv_points(file) : read_snapshot(file);
}

template <int N>
OwnedFrame result_frame(const OwnedFrame& points, const std::vector<const OwnedColumn*>& sources,
                        std::span<const Vec<N>> queries, const approximation::Estimates<N>& estimates,
                        approximation::Degrees degrees) {
  using approximation::Degrees;
  OwnedFrame frame;
  frame.time = points.time;
  frame.step = points.step;
  frame.dimensions = N;
  frame.particles = queries.size();
  const auto add = [&](const std::string& name, const std::string& unit, int components) -> auto& {
    frame.columns.push_back({name, unit, components, {}});
    frame.columns.back().data.reserve(queries.size() * static_cast<std::size_t>(components));
    return frame.columns.back().data;
  };
  auto& x = add("x", "m", N);
  for (const auto& query : queries)
    for (int k = 0; k < N; ++k) x.push_back(query[k]);

  std::size_t first = 0;
  for (const OwnedColumn* source : sources) {
    const int c = source->components;
    const auto each = [&](std::vector<double>& data, auto&& put) {
      for (std::size_t q = 0; q < queries.size(); ++q)
        for (int k = 0; k < c; ++k) put(data, estimates.fields[first + static_cast<std::size_t>(k)][q]);
    };
    each(add(source->name, source->unit, c), [](auto& data, const auto& u) { data.push_back(u.value); });
    if (degrees.gradient != Degrees::not_given)
      each(add("grad_" + source->name, per_length(source->unit, 1), c * N), [](auto& data, const auto& u) {
        for (int a = 0; a < N; ++a) data.push_back(u.gradient[a]);
      });
    if (degrees.hessian != Degrees::not_given) {
      each(add("hessian_" + source->name, per_length(source->unit, 2), c * N * N), [](auto& data, const auto& u) {
        for (int a = 0; a < N; ++a)
          for (int b = 0; b < N; ++b) data.push_back(u.hessian[a][b]);
      });
      each(add("laplacian_" + source->name, per_length(source->unit, 2), c),
           [](auto& data, const auto& u) { data.push_back(u.laplacian()); });
    }
    first += static_cast<std::size_t>(c);
  }
  add("condition", "", 1) = estimates.condition;
  frame.integers.push_back(
      {"neighbours", std::vector<std::int32_t>(estimates.neighbours.begin(), estimates.neighbours.end())});
  std::vector<std::int32_t> status;
  for (const auto one : estimates.status) status.push_back(static_cast<std::int32_t>(one));
  frame.integers.push_back({"status", std::move(status)});
  return frame;
}

std::vector<std::string> write_result(const fs::path& file, const OwnedFrame& result,
                                      const std::vector<std::string>& comments) {
  check(result.view());
  if (file.extension() == ".csv") return write_csv(file, result, comments);
  write_snapshot(file, result.view(), {.fields = Precision::double_precision});
  std::vector<std::string> names;
  for (const auto& column : result.columns) names.push_back(column.name);
  for (const auto& column : result.integers) names.push_back(column.name);
  return names;
}

template OwnedFrame result_frame<1>(const OwnedFrame&, const std::vector<const OwnedColumn*>&, std::span<const Vec<1>>,
                                    const approximation::Estimates<1>&, approximation::Degrees);
template OwnedFrame result_frame<2>(const OwnedFrame&, const std::vector<const OwnedColumn*>&, std::span<const Vec<2>>,
                                    const approximation::Estimates<2>&, approximation::Degrees);
template OwnedFrame result_frame<3>(const OwnedFrame&, const std::vector<const OwnedColumn*>&, std::span<const Vec<3>>,
                                    const approximation::Estimates<3>&, approximation::Degrees);

}  // namespace undine
