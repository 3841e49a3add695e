#include "undine/app/picture/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine {
namespace {

constexpr int fine = 2;        ///< samples per pixel and axis
constexpr int band_rows = 32;  ///< rows of pixels that one thread draws at a time

/// Brightness at a place of the disc, as on the page: light from the upper left.
double brightness(double x, double y, double facing, double shade) {
  const double light = 0.55 + 0.45 * std::clamp(0.85 * facing - 0.35 * y - 0.2 * x, 0.0, 1.0);
  return 1 + (light - 1) * shade;
}

/// Rows [first, last) of the picture, at `fine` samples per pixel.
class Band {
 public:
  Band(int width, int first, int last, Colour background)
      : width_(width * fine),
        first_(first * fine),
        rows_((last - first) * fine),
        colours_(size(), background),
        depths_(size(), -std::numeric_limits<double>::infinity()) {}

  void draw(const Disc& disc, double shade) {
    const double radius = std::max(disc.radius * fine, 0.6), cx = disc.x * fine, cy = disc.y * fine - first_;
    if (!(cy + radius >= 0 && cy - radius <= rows_ && cx + radius >= 0 && cx - radius <= width_)) return;
    const auto from = [](double a) { return std::max(0, static_cast<int>(std::floor(a))); };
    const int right = std::min(width_ - 1, static_cast<int>(std::min(cx + radius, 1e9)));
    const int bottom = std::min(rows_ - 1, static_cast<int>(std::min(cy + radius, 1e9)));
    for (int j = from(cy - radius); j <= bottom; ++j)
      for (int i = from(cx - radius); i <= right; ++i) {
        const double x = (i + 0.5 - cx) / radius, y = (j + 0.5 - cy) / radius;
        const double r2 = x * x + y * y;
        if (r2 > 1) continue;
        const double facing = std::sqrt(1 - r2), depth = disc.depth + disc.bulge * facing;
        const auto at = static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i);
        if (depth <= depths_[at]) continue;
        depths_[at] = depth;
        const double light = brightness(x, y, facing, shade);
        colours_[at] = {disc.colour.red * light, disc.colour.green * light, disc.colour.blue * light};
      }
  }

  /// Averages the samples of each pixel into the picture.
  void resolve(Image& image) const {
    for (int j = 0; j < rows_; j += fine)
      for (int i = 0; i < width_; i += fine) {
        Colour sum;
        for (int k = 0; k < fine * fine; ++k) {
          const Colour& c = colours_[static_cast<std::size_t>(j + k / fine) * static_cast<std::size_t>(width_) +
                                     static_cast<std::size_t>(i + k % fine)];
          sum.red += c.red;
          sum.green += c.green;
          sum.blue += c.blue;
        }
        constexpr double each = 1.0 / (fine * fine);
        const int row = (first_ + j) / fine;
        image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(i / fine)] = {sum.red * each, sum.green * each, sum.blue * each};
      }
  }

 private:
  std::size_t size() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows_); }

  int width_, first_, rows_;
  std::vector<Colour> colours_;
  std::vector<double> depths_;
};

}  // namespace

void draw_discs(Image& image, std::span<const Disc> discs, double shade, Colour background) {
  const int bands = (image.height + band_rows - 1) / band_rows;
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < bands; ++k) {
    Band band(image.width, k * band_rows, std::min((k + 1) * band_rows, image.height), background);
    for (const Disc& disc : discs) band.draw(disc, shade);
    band.resolve(image);
  }
}

}  // namespace undine
