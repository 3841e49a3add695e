#pragma once
#include <span>
#include <vector>

#include "undine/app/picture/colour_map.hpp"

namespace undine {

/// A particle as a disc on a picture.
struct Disc {
  double x = 0, y = 0, radius = 0;  ///< pixels
  double depth = 0;                 ///< towards the viewer; the larger one hides the other
  double bulge = 0;                 ///< how much nearer its middle is than its edge, in the unit of depth
  Colour colour;
};

/// A picture of opaque pixels, row by row from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<Colour> pixels;
  Image(int w, int h, Colour fill)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}
};

/// Draws discs as shaded balls (`shade` 1) or nearly flat ones (0), the nearer before the farther, with smooth edges.
/// The same pixels for any number of threads; of equally near discs the first in the list is seen.
void draw_discs(Image& image, std::span<const Disc> discs, double shade, Colour background);

}  // namespace undine
