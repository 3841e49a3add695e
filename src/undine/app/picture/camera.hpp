#pragma once
#include "undine/core/vec.hpp"

namespace undine {

/// The corners of a box in space, m.
struct Box3 {
  Vec<3> low{}, high{};
};

/// Where a point lands on a picture.
struct Seen {
  double x = 0, y = 0;  ///< pixels, from the left and from the top
  double depth = 0;     ///< m towards the viewer
  double scale = 0;     ///< pixels per m there
  bool ahead = true;    ///< whether it is in front of the viewer
};

struct CameraOptions {
  double azimuth = 19;    ///< degrees to the right, around the upward axis
  double elevation = 21;  ///< degrees above the horizon
  double zoom = 1;
  bool perspective = true;
};

/// A part of a picture, pixels.
struct Area {
  double left = 0, top = 0, width = 0, height = 0;
};

/// Looks at a box so that it fills an area.
class Camera {
 public:
  /// In a plane: x to the right, y upwards.
  static Camera flat(const Box3& box, const Area& area, double zoom);
  /// In space, the longer side of the box across at azimuth 0. `up` is an axis, with its sign.
  static Camera around(const Box3& box, const Area& area, Vec<3> up, const CameraOptions& options);

  Seen see(const Vec<3>& point) const;
  /// Whether the viewer is outside of a face of a box: the one at its higher end along the axis, or at its lower.
  bool faces(const Box3& box, int axis, bool higher) const;

 private:
  void fill(const Box3& box, const Area& area, double zoom);

  Vec<3> right_{{1, 0, 0}}, up_{{0, 1, 0}}, toward_{{0, 0, 1}}, target_{};
  double distance_ = 0;  ///< of the viewer from the target; 0: parallel rays
  double scale_ = 1;     ///< pixels per m at the target
  double x_ = 0, y_ = 0;
};

}  // namespace undine
