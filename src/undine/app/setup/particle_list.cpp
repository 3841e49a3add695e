#include "undine/app/setup/particle_list.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "undine/app/case_shapes.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/geometry/points.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

/// Particles that a case takes from a file.
struct ParticleList {
  std::vector<Vec3> points;
  std::map<std::string, std::vector<double>> given;  ///< columns, as of a body
  bool of_a_run = false;                             ///< from a snapshot: as a run left them
};

ParticleList read_csv_list(const Table& table, const fs::path& file, int dimensions) {
  auto rows = load_points_csv(file.string(), dimensions);
  const std::vector<std::string> known{"vx", "vy", "vz", "rho", "m"};
  ParticleList list{std::move(rows.points), {}};
  for (std::size_t k = 0; k < rows.names.size(); ++k) {
    const std::string& name = rows.names[k];
    if (std::ranges::count(known, name) == 0) {
      const auto best = did_you_mean(name, known);
      table.fail("particles", fmt::format("'{}' has the unknown column '{}'", file.string(), name), {},
                 fmt::format("{}{}known columns: x, y, z, {}", best, best.empty() ? "" : " ", listed(known)));
    }
    list.given[name] = std::move(rows.columns[k]);
  }
  return list;
}

/// Keeps the particles of one group, where the snapshot says which group each is of.
void keep_group(ParticleList& list, const OwnedFrame& frame, Group group) {
  const auto* groups = frame.find_integers("group");
  if (!groups) return;
  const auto kept = [&](auto& values) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < frame.particles; ++i)
      if (groups->at(i) == static_cast<int>(group)) values[n++] = values[i];
    values.resize(n);
  };
  kept(list.points);
  for (auto& [name, values] : list.given) kept(values);
}

ParticleList read_snapshot_list(const Table& table, const fs::path& file, int dimensions, Group group) {
  const OwnedFrame frame = [&] {
    try {
      return read_snapshot(file);
    } catch (const InputError& error) {
      table.fail("particles", error.parts().what, error.parts().why,
                 "name a table with columns x, y, z (.csv) or a snapshot in HDF5 that Undine wrote (.vtkhdf)");
    }
  }();
  if (frame.dimensions != dimensions)
    table.fail("particles", fmt::format("the particles of '{}' have {} coordinates", file.string(), frame.dimensions),
               fmt::format("the case has {} dimensions", dimensions),
               "name a snapshot of as many dimensions, or change 'dimensions'");
  const auto n = static_cast<std::size_t>(dimensions);
  ParticleList list{std::vector<Vec3>(frame.particles), {}};
  const auto& x = frame.find(frame.position)->data;
  for (std::size_t i = 0; i < frame.particles; ++i)
    for (std::size_t k = 0; k < n; ++k) list.points[i][static_cast<int>(k)] = x[i * n + k];
  for (const char* name : {"rho", "m"})
    if (const auto* column = frame.find(name); column && column->components == 1) list.given[name] = column->data;
  if (const auto* v = frame.find("v"); v && v->components == dimensions)
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < frame.particles; ++i)
        list.given[std::string("v") + "xyz"[k]].push_back(v->data[i * n + k]);
  keep_group(list, frame, group);
  list.of_a_run = true;
  return list;
}

void check_values(const Table& table, const fs::path& file, const ParticleList& list) {
  const auto bad = [&](std::size_t i, std::string_view name, double value, std::string_view rule) {
    const Vec3& p = list.points[i];
    table.fail("particles", fmt::format("{} is {:.6g} in particle {} of '{}'", name, value, i + 1, file.string()),
               fmt::format("the particle at ({:.4g}, {:.4g}, {:.4g}) m; it must be {}", p[0], p[1], p[2], rule),
               "correct the list");
  };
  for (std::size_t i = 0; i < list.points.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (!std::isfinite(list.points[i][k])) bad(i, std::string(1, "xyz"[k]), list.points[i][k], "a finite number");
  for (const auto& [name, values] : list.given) {
    const bool amount = name == "rho" || name == "m";
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i]) || (amount && values[i] <= 0))
        bad(i, name, values[i], amount ? "greater than 0" : "a finite number");
  }
}

}  // namespace

void take_particle_list(Body& body, int dimensions) {
  const Table& table = body.table;
  const fs::path file = existing_file(table, "particles");
  ParticleList list = file.extension() == ".csv" ? read_csv_list(table, file, dimensions)
                                                 : read_snapshot_list(table, file, dimensions, body.group);
  check_values(table, file, list);
  body.of_a_run = list.of_a_run;
  body.points = std::move(list.points);
  body.given = std::move(list.given);
}

}  // namespace undine
