#include "undine/app/case_particles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/geometry/points.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

constexpr double bytes_per_particle = 500;  ///< fields and neighbour lists, about

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

/// Bytes that a run may take: the machine's, or less where the process or UNDINE_MEMORY (in bytes) is limited to less.
double memory_here() {
  double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (rlimit limit{}; getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    memory = std::min(memory, static_cast<double>(limit.rlim_cur));
  if (const char* allowed = std::getenv("UNDINE_MEMORY"))
    if (const double bytes = std::strtod(allowed, nullptr); bytes > 0) memory = std::min(memory, bytes);
  return memory;
}

}  // namespace

fs::path existing_file(const Table& table, std::string_view key) {
  const fs::path file = table.path(key);
  std::error_code failure;
  if (!fs::is_regular_file(file, failure))
    table.fail(key, fmt::format("there is no file '{}'", file.string()), {},
               "check the path; names are relative to the case file's folder");
  return file;
}

ParticleList read_particle_list(const Table& table, int dimensions, Group group) {
  const fs::path file = existing_file(table, "particles");
  ParticleList list = file.extension() == ".csv" ? read_csv_list(table, file, dimensions)
                                                 : read_snapshot_list(table, file, dimensions, group);
  check_values(table, file, list);
  return list;
}

void check_room(const Table& table, double count, double spacing) {
  const double memory = memory_here();
  if (count * bytes_per_particle <= memory) return;
  throw InputError(
      {.what = "the spacing makes more particles than this machine can hold",
       .where = table.where(),
       .why = fmt::format("about {:.2g} particles {:.4g} m apart would take {:.2g} GB of the {:.2g} GB here", count,
                          spacing, count * bytes_per_particle * 1e-9, memory * 1e-9),
       .fix = "choose a larger spacing or a smaller body; lengths are in metres"});
}

double lattice_points(const Bounds& box, double spacing, double margin, int dimensions) {
  const double least = margin < 0 ? 0 : 1;  // a flat box holds one layer, what is inside its skin may be nothing
  double count = 1;
  for (int k = 0; k < dimensions; ++k) count *= std::max(least, (box.hi[k] - box.lo[k] + 2 * margin) / spacing);
  return count;
}

}  // namespace undine
