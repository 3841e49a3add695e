#include "undine/app/picture/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace undine {
namespace {

constexpr double distance_in_radii = 3.4;  ///< as the page has it

Vec<3> cross3(const Vec<3>& a, const Vec<3>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

double dot3(const Vec<3>& a, const Vec<3>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec<3> corner(const Box3& box, int which) {
  return {{which & 1 ? box.high[0] : box.low[0], which & 2 ? box.high[1] : box.low[1],
           which & 4 ? box.high[2] : box.low[2]}};
}

}  // namespace

Seen Camera::see(const Vec<3>& point) const {
  const Vec<3> from = point - target_;
  const double depth = dot3(from, toward_);
  const double away = distance_ - depth;
  const double scale = distance_ > 0 ? scale_ * distance_ / away : scale_;
  return {x_ + dot3(from, right_) * scale, y_ - dot3(from, up_) * scale, depth, scale,
          distance_ == 0 || away > 0.05 * distance_};
}

bool Camera::faces(const Box3& box, int axis, bool higher) const {
  if (distance_ == 0) return higher ? toward_[axis] > 0 : toward_[axis] < 0;
  const double eye = target_[axis] + distance_ * toward_[axis];
  return higher ? eye > box.high[axis] : eye < box.low[axis];
}

/// Chooses scale and place so that the corners of the box touch the area's edges.
void Camera::fill(const Box3& box, const Area& area, double zoom) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double left = infinity, right = -infinity, top = infinity, bottom = -infinity;
  scale_ = 1;
  x_ = y_ = 0;
  for (int which = 0; which < 8; ++which) {
    const Seen seen = see(corner(box, which));
    left = std::min(left, seen.x);
    right = std::max(right, seen.x);
    top = std::min(top, seen.y);
    bottom = std::max(bottom, seen.y);
  }
  scale_ = zoom * std::min(area.width / std::max(right - left, 1e-12), area.height / std::max(bottom - top, 1e-12));
  x_ = area.left + area.width / 2 - scale_ * (left + right) / 2;
  y_ = area.top + area.height / 2 - scale_ * (top + bottom) / 2;
}

Camera Camera::flat(const Box3& box, const Area& area, double zoom) {
  Camera camera;
  camera.target_ = 0.5 * (box.low + box.high);
  camera.fill(box, area, zoom);
  return camera;
}

Camera Camera::around(const Box3& box, const Area& area, Vec<3> up, const CameraOptions& options) {
  const Vec<3> extent = box.high - box.low;
  int across = -1;
  for (int k = 0; k < 3; ++k)
    if (std::abs(up[k]) < 0.5 && (across < 0 || extent[k] > extent[across])) across = k;
  Vec<3> side{};
  side[across] = 1;
  const Vec<3> front = cross3(side, up);
  const double degree = std::numbers::pi / 180;
  const double turn = options.azimuth * degree, rise = options.elevation * degree;
  Camera camera;
  camera.target_ = 0.5 * (box.low + box.high);
  camera.toward_ = std::cos(rise) * (std::cos(turn) * front + std::sin(turn) * side) + std::sin(rise) * up;
  camera.right_ = std::cos(turn) * side - std::sin(turn) * front;
  camera.up_ = cross3(camera.toward_, camera.right_);
  if (options.perspective) camera.distance_ = distance_in_radii * 0.5 * std::sqrt(dot3(extent, extent));
  camera.fill(box, area, options.zoom);
  return camera;
}

}  // namespace undine
