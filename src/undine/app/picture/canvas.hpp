#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "undine/app/picture/camera.hpp"
#include "undine/app/picture/raster.hpp"

namespace undine {

enum class Align { left, centre, right };

/// A picture that texts and lines are drawn on, and its file.
class Canvas {
 public:
  explicit Canvas(const Image& image);

  /// Lower edge of the letters at y; size in pixels. Returns nothing: texts that are too long are cut at the edge.
  void text(double x, double y, double size, const std::string& text, Align align, Colour ink);
  void line(double x0, double y0, double x1, double y1, double width, Colour ink);
  void rectangle(const Area& area, Colour fill);
  double text_width(double size, const std::string& text);

  /// Throws Error.
  void write_png(const std::filesystem::path& file);
  /// Rows of blue, green, red and an unused byte, as video encoders call bgr0.
  const std::vector<unsigned char>& bytes() const { return bytes_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_, height_;
  std::vector<unsigned char> bytes_;
};

}  // namespace undine
