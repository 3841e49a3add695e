#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "undine/geometry/faces.hpp"
#include "undine/geometry/shape.hpp"

namespace undine {

/// What became of a step against elastic walls.
struct Reflection {
  Vec3 position{};         ///< m, on the fluid's side of every wall
  Vec3 velocity{};         ///< m/s
  int hits = 0;            ///< reflections
  Vec3 velocity_change{};  ///< m/s, new minus old; the walls took the momentum -m times this
  double travelled = 0;    ///< m, length of the broken path
  bool stopped = false;    ///< the path was cut short: too many reflections, or no room
};

/// Walls off which a point bounces like light off a mirror: any number of tanks, obstacles, planes and meshes.
/// The fluid is where all of them allow it. Threads may share it while nobody places its walls.
class ReflectingSurface {
 public:
  static constexpr int most_hits = 16;

  /// The fluid stays inside the box (m; axes beyond `dimensions` are unbounded). Through an `open` face it may leave;
  /// the walls beside it then go on without end. Restitution is the share of the normal speed kept, 0..1.
  /// Like the others that add, it returns the wall's number.
  std::size_t add_tank(const Bounds& box, int dimensions, const FaceSet& open = {}, double restitution = 1);

  /// The fluid stays on one side of any shape: outside of an obstacle, inside of a vessel.
  std::size_t add(ShapePtr shape, Side fluid, double restitution = 1);

  /// The fluid stays on the side of the plane that the normal points to.
  std::size_t add_plane(const Vec3& point, const Vec3& normal_to_fluid, double restitution = 1);

  /// Puts a wall `offset` (m) from where it was added, moving at `velocity` (m/s): paths are mirrored at it there, and
  /// velocities in its frame.
  void place(std::size_t wall, const Vec3& offset, const Vec3& velocity);

  /// True only if the step surely meets no wall. A few nanoseconds for tanks and for obstacles far away.
  bool clear(const Vec3& from, const Vec3& to) const {
    for (const Wall& wall : walls_) {
      if (!wall.clear(from, to)) return false;
    }
    return true;
  }

  /// Follow the step, mirrored at each wall it meets; the velocity is mirrored with it. A start on or outside a wall
  /// counts as just inside. Whatever comes in, the end is on the fluid's side, unless there is no room for fluid near
  /// `from` or a number is not finite; then the step is returned as it is, `stopped`.
  Reflection reflect(const Vec3& from, const Vec3& to, const Vec3& velocity) const;

  /// How far p is on the fluid's side of the nearest wall, in metres; negative inside a wall.
  double depth(const Vec3& p) const;

  /// How far p is on the fluid's side of one wall, and the unit normal there, towards the fluid.
  double depth(std::size_t wall, const Vec3& p) const { return walls_[wall].depth(p); }
  Vec3 normal(std::size_t wall, const Vec3& p) const { return walls_[wall].normal(p); }

  /// The nearest place on the way out along the normals that is at least `distance` (m) from every wall; in a corner
  /// too narrow for that, where a few pushes by one wall after the other end.
  Vec3 pushed_out(Vec3 p, double distance) const;

  bool empty() const { return walls_.empty(); }

 private:
  struct Wall {
    ShapePtr shape;
    Side fluid;
    double restitution;
    Bounds bounds;
    bool tank;  ///< a box with the fluid inside
    Vec3 offset{}, velocity{};

    bool clear(const Vec3& start, const Vec3& end) const {
      const Vec3 from = start - offset, to = end - offset;
      if (tank) return bounds.holds(from) && bounds.holds(to);
      if (fluid == Side::outside && bounds.clear_of(from, to)) return true;
      return shape->clear(from, to, fluid);
    }
    double depth(const Vec3& p) const;
    Vec3 normal(const Vec3& p) const;  ///< towards the fluid
    std::optional<Crossing> first_crossing(const Vec3& from, const Vec3& to) const;
  };
  struct Contact;

  const Wall* nearest(const Vec3& p, double& depth) const;
  std::optional<Vec3> settled(Vec3 p, double inset) const;
  std::optional<Contact> first_contact(const Vec3& from, const Vec3& to) const;
  Contact search_contact(const Vec3& from, const Vec3& to) const;

  std::vector<Wall> walls_;
  double scale_ = 0;
};

}  // namespace undine
