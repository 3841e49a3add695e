#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "undine/geometry/mesh.hpp"

namespace undine {

/// Where a segment meets a triangle.
struct Hit {
  double fraction = 0;  ///< of the segment, 0..1
  Vec3 point{};         ///< m
  Vec3 normal{};        ///< unit, against the motion
  int triangle = -1;
};

/// Which hits count: those into the body, those out of it, or all.
enum class Facing { entering, leaving, any };

/// The nearest point of a mesh.
struct Closest {
  Vec3 point{};                 ///< m
  double distance = unbounded;  ///< m, never negative
  Vec3 normal{};                ///< outward pseudo-normal of the face, edge or corner that holds the point (not unit)
  int triangle = -1;
};

/// A tree of boxes around the triangles of a mesh. Rays through shared edges and corners never slip between triangles.
class Bvh {
 public:
  /// The mesh must have at least one triangle. For `inside` and signed answers it must be watertight and face outward.
  explicit Bvh(TriangleMesh mesh);

  std::optional<Hit> first_hit(const Vec3& from, const Vec3& to, Facing facing = Facing::any) const;

  /// All hits, in no order; one through an edge or corner may come several times. Normals point outward.
  std::vector<Cut> all_hits(const Vec3& from, const Vec3& to) const;

  /// By the parity of a ray, tried in several directions until one stays off all edges.
  bool inside(const Vec3& p) const;

  Closest closest(const Vec3& p) const;
  double distance(const Vec3& p) const { return closest(p).distance; }

  /// Negative inside; the sign is that of the pseudo-normal (Baerentzen and Aanaes 2005).
  double signed_distance(const Vec3& p) const;

  const TriangleMesh& mesh() const { return mesh_; }
  const Bounds& bounds() const { return nodes_.front().box; }

 private:
  struct Node {
    Bounds box;
    int first = 0;  ///< a leaf: first of its triangles in order_; else the left child, the right one follows `right`
    int count = 0;  ///< 0: not a leaf
    int right = 0;
  };
  struct Ray;
  struct Touch;

  int build(int first, int count, std::vector<Vec3>& centres, double margin);
  void find_pseudo_normals();
  Touch meet(const Ray& ray, int triangle) const;
  Closest closest_on(int triangle, const Vec3& p) const;
  template <class Visit>
  void along(const Ray& ray, double& limit, Visit visit) const;

  TriangleMesh mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
  std::vector<Vec3> face_normals_;                 ///< unit
  std::vector<Vec3> vertex_normals_;               ///< weighted by angle
  std::vector<std::array<Vec3, 3>> edge_normals_;  ///< of edge k from corner k to k+1
};

}  // namespace undine
