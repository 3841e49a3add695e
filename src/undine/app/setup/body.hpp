#pragma once
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "undine/engine/store.hpp"
#include "undine/geometry/surface.hpp"
#include "undine/io/case/table.hpp"

namespace undine {

/// Particles of one body before they enter the store.
struct Body {
  std::string name;
  Group group;
  int material = 0;
  std::vector<Vec3> points;  ///< m
  std::map<std::string, std::vector<double>>
      given;  ///< columns of a particle list: vx, vy, vz (m/s), rho (kg/m^3), m (kg), where the file has them
  Table table;
  bool of_a_run = false;     ///< particles that a run left, which may be closer than any lattice lays them
  bool may_coincide = true;  ///< points that a lattice laid are apart from each other
  int motion = -1;           ///< of a wall: its number in WallPlan::motions
  std::shared_ptr<ReflectingSurface> surface = {};  ///< of a wall with a shape: that alone
  double coarser = 1;                               ///< spacing of a fluid's lattice over the case's
};

/// Marks keys that this choice does not use, so that Undine does not call them unknown.
inline void leave_unused(const Table& table, std::initializer_list<const char*> keys) {
  for (const char* key : keys) (void)table.has(key);
}

}  // namespace undine
