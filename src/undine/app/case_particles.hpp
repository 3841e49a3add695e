#pragma once
#include <map>
#include <string>
#include <vector>

#include "undine/engine/store.hpp"
#include "undine/geometry/bounds.hpp"
#include "undine/io/case/table.hpp"

namespace undine {

/// Particles that a case takes from a file.
struct ParticleList {
  std::vector<Vec3> points;  ///< m
  std::map<std::string, std::vector<double>>
      given;              ///< columns vx, vy, vz (m/s), rho (kg/m^3) and m (kg), where the file has them
  bool of_a_run = false;  ///< from a snapshot: as a run left them
};

/// The file that key `particles` of a body's table names: comma-separated values (.csv) or a snapshot, of which
/// the particles of the body's group are taken. Throws InputError with the place in the list or, where a list has none,
/// in the case.
ParticleList read_particle_list(const Table& table, int dimensions, Group group);

/// The file that a key names, which must exist. Throws InputError at the key.
std::filesystem::path existing_file(const Table& table, std::string_view key);

/// Throws InputError at the table if `count` particles do not fit into this machine's memory.
void check_room(const Table& table, double count, double spacing);

/// How many lattice points of that spacing a box holds along its first `dimensions` axes; `margin` (m) is added on
/// each side, or taken off where negative.
double lattice_points(const Bounds& box, double spacing, double margin, int dimensions);

}  // namespace undine
