#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "undine/geometry/bounds.hpp"
#include "undine/geometry/span.hpp"

namespace undine {

enum class Side { inside, outside };

/// Where a segment leaves one side of a shape.
struct Crossing {
  double fraction = 0;  ///< of the segment, 0..1
  Vec3 point{};         ///< m
  Vec3 normal{};        ///< unit, towards the side that is left
};

/// A plane face: a point on it, and its unit normal.
struct FlatFace {
  Vec3 point{};  ///< m
  Vec3 normal{};
};
/// A convex region: what is behind all its faces, whose normals point out of it.
using FlatPart = std::vector<FlatFace>;

/// A region of space. Cases in one and two dimensions use the same shapes with the unused coordinates 0.
/// Shapes never change once made, so that threads may share them.
class Shape {
 public:
  virtual ~Shape() = default;

  /// Distance to the surface in metres, negative inside. Exact for primitives and meshes; for unions, differences
  /// and intersections the sign is right and the size never too large.
  virtual double signed_distance(const Vec3& p) const = 0;

  /// The outward unit normal of the surface nearest to p.
  virtual Vec3 normal(const Vec3& p) const = 0;

  /// A box that holds the shape; infinite where the shape is.
  virtual Bounds bounds() const = 0;

  /// The parts of the segment inside the shape.
  virtual Spans spans(const Vec3& from, const Vec3& to) const = 0;

  virtual bool inside(const Vec3& p) const { return signed_distance(p) < 0; }

  /// The first point of the segment where it leaves `side`.
  virtual std::optional<Crossing> first_crossing(const Vec3& from, const Vec3& to, Side side) const;

  /// True only if the whole segment surely stays on `side` and off the surface. Cheap; may say false too often.
  virtual bool clear(const Vec3& from, const Vec3& to, Side side) const;

  /// Appends convex regions with flat faces that together fill one side of the shape. False, with `parts` as it likes,
  /// where the shape cannot say them: it is round, or a net of triangles.
  virtual bool flat_parts(Side side, std::vector<FlatPart>& parts) const;

  /// The box itself if the shape is one.
  virtual std::optional<Bounds> as_box() const { return std::nullopt; }
};

using ShapePtr = std::shared_ptr<const Shape>;

/// The plane of a polygon; it is extruded along the axis left out.
enum class PolygonPlane { xy, xz };

struct PolygonSpec {
  std::vector<std::array<double, 2>> corners;  ///< m, in order, either way round; the last joins the first
  PolygonPlane plane = PolygonPlane::xy;
  double extrude_from = -unbounded;  ///< m, along the axis left out
  double extrude_to = unbounded;
};

/// Box from corner to corner (m); axes beyond `dimensions` are unbounded, and infinite coordinates are allowed.
/// All factories throw InputError on sizes that make no shape.
ShapePtr make_box(const Vec3& lo, const Vec3& hi, int dimensions = 3);
ShapePtr make_sphere(const Vec3& centre, double radius);
/// Solid cylinder between the centres of its two end discs.
ShapePtr make_cylinder(const Vec3& from, const Vec3& to, double radius);
/// All points behind the plane; the normal (any length) points out of the half-space.
ShapePtr make_half_space(const Vec3& point, const Vec3& outward_normal);
ShapePtr make_polygon(const PolygonSpec& spec);
ShapePtr make_union(std::vector<ShapePtr> parts);
ShapePtr make_intersection(std::vector<ShapePtr> parts);
/// `whole` without `hole`.
ShapePtr make_difference(ShapePtr whole, ShapePtr hole);

}  // namespace undine
