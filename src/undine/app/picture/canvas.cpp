#include "undine/app/picture/canvas.hpp"

#include <cmath>
#include <memory>

#include <cairo.h>
#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/io/atomic_file.hpp"

namespace undine {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

Surface surface_on(std::vector<unsigned char>& bytes, int width, int height) {
  return {cairo_image_surface_create_for_data(bytes.data(), CAIRO_FORMAT_RGB24, width, height, 4 * width),
          cairo_surface_destroy};
}

/// Draws with `act` and lets go of everything again.
template <class F>
void draw(std::vector<unsigned char>& bytes, int width, int height, Colour ink, F&& act) {
  const Surface surface = surface_on(bytes, width, height);
  const Pen pen(cairo_create(surface.get()), cairo_destroy);
  cairo_set_source_rgb(pen.get(), ink.red, ink.green, ink.blue);
  act(pen.get());
  cairo_surface_flush(surface.get());
}

void choose_font(cairo_t* pen, double size) {
  cairo_select_font_face(pen, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen, size);
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_set_font_options(pen, options);
  cairo_font_options_destroy(options);
}

unsigned char level(double share) { return static_cast<unsigned char>(std::lround(255 * share)); }

}  // namespace

Canvas::Canvas(const Image& image) : width_(image.width), height_(image.height), bytes_(4 * image.pixels.size()) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    bytes_[4 * i] = level(image.pixels[i].blue);
    bytes_[4 * i + 1] = level(image.pixels[i].green);
    bytes_[4 * i + 2] = level(image.pixels[i].red);
    bytes_[4 * i + 3] = 255;
  }
}

double Canvas::text_width(double size, const std::string& text) {
  double width = 0;
  draw(bytes_, width_, height_, {}, [&](cairo_t* pen) {
    choose_font(pen, size);
    cairo_text_extents_t extents;
    cairo_text_extents(pen, text.c_str(), &extents);
    width = extents.x_advance;
  });
  return width;
}

void Canvas::text(double x, double y, double size, const std::string& text, Align align, Colour ink) {
  const double shift = align == Align::left ? 0 : text_width(size, text) * (align == Align::right ? 1 : 0.5);
  draw(bytes_, width_, height_, ink, [&](cairo_t* pen) {
    choose_font(pen, size);
    cairo_move_to(pen, x - shift, y);
    cairo_show_text(pen, text.c_str());
  });
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, Colour ink) {
  draw(bytes_, width_, height_, ink, [&](cairo_t* pen) {
    cairo_set_line_width(pen, width);
    cairo_move_to(pen, x0, y0);
    cairo_line_to(pen, x1, y1);
    cairo_stroke(pen);
  });
}

void Canvas::rectangle(const Area& area, Colour fill) {
  draw(bytes_, width_, height_, fill, [&](cairo_t* pen) {
    cairo_rectangle(pen, area.left, area.top, area.width, area.height);
    cairo_fill(pen);
  });
}

void Canvas::write_png(const std::filesystem::path& file) {
  AtomicFile target(file);
  const Surface surface = surface_on(bytes_, width_, height_);
  const cairo_status_t status = cairo_surface_write_to_png(surface.get(), target.temporary().c_str());
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error({.what = fmt::format("cannot write '{}'", file.string()),
                 .why = cairo_status_to_string(status),
                 .fix = "check that the folder exists and that you may write to it"});
  target.commit();
}

}  // namespace undine
