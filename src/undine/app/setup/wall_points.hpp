#pragma once
#include <vector>

#include "undine/app/case_setup.hpp"
#include "undine/geometry/faces.hpp"
#include "undine/geometry/shape.hpp"

namespace undine {

/// Where a wall is.
struct WallShape {
  ShapePtr shape;  ///< empty where particles from a list are all there is
  Side fluid = Side::inside;
  FaceSet open;
};

/// Lays the particles of a [[wall]]: layers behind its surface, or a sheet on the faces of a box. `treatment`: the
/// table [scheme.wall]. Throws InputError.
template <int N>
std::vector<Vec3> wall_points(const Table& table, const WallShape& wall, const Table& treatment,
                              const CaseSetup<N>& setup);

/// How far apart particles that repel lie, m: closer than those of the fluid they make a smoother wall. Throws
/// InputError at the key.
double repelling_spacing(const Table& treatment, double spacing);

/// Whether particles that repel lie half of their spacing behind the surface: Niedoba (2012), 3.3.
bool repelling_shift(const Table& treatment);

}  // namespace undine
