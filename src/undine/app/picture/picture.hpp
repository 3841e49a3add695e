#pragma once
#include <optional>
#include <string>
#include <utility>

#include "undine/app/picture/camera.hpp"
#include "undine/app/picture/canvas.hpp"
#include "undine/app/run/folder.hpp"

namespace undine {

enum class WallStyle {
  behind,  ///< grey; in 3-D without those between the viewer and what is in the box
  grey,
  coloured,
  hidden
};

/// A plane across an axis, beyond which nothing is drawn.
struct CutAway {
  int axis = 0;
  bool above = true;  ///< cuts away what is above `at`, else what is below
  double at = 0;      ///< m
};

/// How particles are drawn; the same for all pictures of a movie.
struct PictureStyle {
  std::string colour = "v";  ///< field, as find_scalar takes it
  std::string map = "viridis";
  std::string title = {};
  int width = 1280, height = 720;
  WallStyle walls = WallStyle::behind;
  std::optional<CutAway> cut = {};
  CameraOptions camera = {};
  Vec<3> up{{0, 0, 1}};          ///< against gravity
  int wall_layers = 3;           ///< of particles, the most that a wall has
  double spacing = 0;            ///< of the particles, m
  std::optional<Box3> box = {};  ///< what fills the picture; the particles themselves where it is not given
  bool inner = false;            ///< whether the range leaves out the lowest and the highest hundredth of the fluid
  std::optional<std::pair<double, double>> range = {};  ///< of the colours; that of the fluid where it is not given
};

/// Bounds of the particles that are drawn.
Box3 bounds_of(const OwnedFrame& frame, const PictureStyle& style);

/// Lowest and highest value of the fluid; 0 to 1 where there is none.
std::pair<double, double> range_of(const OwnedFrame& frame, const PictureStyle& style);

/// Draws one time of a run with title, time and legend. Throws InputError where the snapshot lacks the field.
Canvas draw_picture(const OwnedFrame& frame, double time, const PictureStyle& style);

}  // namespace undine
