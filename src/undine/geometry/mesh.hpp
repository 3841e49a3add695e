#pragma once
#include <array>
#include <string>
#include <vector>

#include "undine/geometry/bounds.hpp"
#include "undine/geometry/shape.hpp"

namespace undine {

/// A surface of triangles; corners run anticlockwise seen from outside.
struct TriangleMesh {
  std::vector<Vec3> vertices;                 ///< m
  std::vector<std::array<int, 3>> triangles;  ///< indices of vertices
  std::string source;                         ///< the file it came from, for messages; may be empty
};

/// Read an ASCII or binary STL file, weld its vertices, and turn the surface so that its volume is positive.
/// Coordinates are taken times `scale` (0.001 for a drawing in mm). InputError names file and line or triangle.
TriangleMesh load_stl(const std::string& path, double scale = 1);

enum class StlFormat { ascii, binary };
void write_stl(const TriangleMesh& mesh, const std::string& path, StlFormat format);

/// Merge vertices closer than `tolerance` times the diagonal of the bounds, and drop triangles that thereby vanish.
TriangleMesh weld(const TriangleMesh& mesh, double tolerance = 1e-6);

/// InputError unless each edge joins exactly two triangles that agree which side is out. It tells the number of open
/// edges and holes, the coordinates of the first rims, edges with three or more triangles, and disagreeing ones.
void check_watertight(const TriangleMesh& mesh);

/// The enclosed volume in m^3, negative when the triangles face inward.
double signed_volume(const TriangleMesh& mesh);

/// Turn all triangles round if the volume is negative.
void orient_outward(TriangleMesh& mesh);

Bounds bounds_of(const TriangleMesh& mesh);

/// The region that a mesh encloses; checks that it is watertight, and orients it outward.
ShapePtr make_mesh(TriangleMesh mesh);

}  // namespace undine
