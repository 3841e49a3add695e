#include "undine/app/picture/picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "undine/app/picture/colour_map.hpp"
#include "undine/app/picture/legend.hpp"
#include "undine/core/error.hpp"

namespace undine {
namespace {

constexpr Colour paper{1, 1, 1}, ink{0.10, 0.14, 0.19}, wall_grey{0.76, 0.79, 0.82}, edge_grey{0.60, 0.65, 0.70};
constexpr double flat_shade = 0.25;

/// Sizes that follow that of the picture.
struct Layout {
  explicit Layout(const PictureStyle& style)
      : letters(std::max(11.0, std::min(style.height, style.width) / 34.0)), gap(letters) {
    const double head = 2.4 * letters, foot = 4.6 * letters;
    view = {gap, head, style.width - 2 * gap, style.height - head - foot};
    legend = {gap, style.height - foot + 0.6 * letters, std::min(0.45 * style.width, 26 * letters),
              foot - 0.9 * letters};
  }
  double letters, gap;
  Area view, legend;
};

Vec<3> place_of(const OwnedColumn& x, int dimensions, std::size_t i) {
  Vec<3> place{};
  for (int k = 0; k < dimensions; ++k)
    place[k] = x.data[i * static_cast<std::size_t>(dimensions) + static_cast<std::size_t>(k)];
  return place;
}

bool finite(const Vec<3>& a) { return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]); }

bool cut_away(const PictureStyle& style, const Vec<3>& place) {
  if (!style.cut) return false;
  const double beyond = place[style.cut->axis] - style.cut->at;
  return style.cut->above ? beyond > 0 : beyond < 0;
}

/// Diameter of a particle in spacings, as on the page: more than one, so that a fluid has no gaps.
double diameter(int dimensions) { return dimensions < 3 ? 1.45 : 1.15; }

/// Whether a wall particle stands between the viewer and what is in the box: it is near a face that the viewer looks
/// at, and near none of the others.
bool in_the_way(const Vec<3>& place, const Box3& box, const Camera& camera, double depth) {
  bool front = false, behind = false;
  for (int k = 0; k < 3; ++k)
    for (const bool higher : {false, true}) {
      if (higher ? place[k] <= box.high[k] - depth : place[k] >= box.low[k] + depth) continue;
      (camera.faces(box, k, higher) ? front : behind) = true;
    }
  return front && !behind;
}

Camera camera_for(const OwnedFrame& frame, const PictureStyle& style, const Box3& box, const Area& area) {
  return frame.dimensions < 3 ? Camera::flat(box, area, style.camera.zoom)
                              : Camera::around(box, area, style.up, style.camera);
}

}  // namespace

Box3 bounds_of(const OwnedFrame& frame, const PictureStyle& style) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<char> walls = walls_of(frame);
  const OwnedColumn& x = *frame.find(frame.position);
  Box3 box{.low = {{infinity, infinity, infinity}}, .high = {{-infinity, -infinity, -infinity}}};
  for (std::size_t i = 0; i < frame.particles; ++i) {
    const Vec<3> place = place_of(x, frame.dimensions, i);
    if (!finite(place) || (walls[i] && style.walls == WallStyle::hidden)) continue;
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], place[k]);
      box.high[k] = std::max(box.high[k], place[k]);
    }
  }
  if (!(box.low[0] <= box.high[0])) box = {};
  for (int k = 0; k < 3; ++k) {
    box.low[k] -= style.spacing / 2;
    box.high[k] += style.spacing / 2;
  }
  return box;
}

std::pair<double, double> range_of(const OwnedFrame& frame, const PictureStyle& style) {
  const ScalarChoice choice = find_scalar(frame, style.colour);
  const FluidRange range = fluid_range(scalar_values(*frame.find(choice.field), choice.part), walls_of(frame));
  if (!(range.low <= range.high)) return {0.0, 1.0};
  return style.inner ? std::pair(range.inner_low, range.inner_high) : std::pair(range.low, range.high);
}

Canvas draw_picture(const OwnedFrame& frame, double time, const PictureStyle& style) {
  const ScalarChoice choice = find_scalar(frame, style.colour);
  const OwnedColumn& column = *frame.find(choice.field);
  const std::vector<double> values = scalar_values(column, choice.part);
  const std::vector<char> walls = walls_of(frame);
  const ColourMap map = ColourMap::find(style.map);
  auto [low, high] = style.range ? *style.range : range_of(frame, style);
  if (!style.range && map.is_signed() && low < 0 && high > 0) low = -(high = std::max(-low, high));

  const Layout layout(style);
  const Box3 box = style.box ? *style.box : bounds_of(frame, style);
  const Camera camera = camera_for(frame, style, box, layout.view);
  const bool opened = frame.dimensions == 3 && style.walls == WallStyle::behind;
  const double radius = 0.5 * diameter(frame.dimensions) * style.spacing;
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < frame.particles; ++i) {
    const Vec<3> place = place_of(*frame.find(frame.position), frame.dimensions, i);
    if (!finite(place) || cut_away(style, place) || (walls[i] && style.walls == WallStyle::hidden)) continue;
    if (opened && walls[i] && in_the_way(place, box, camera, style.wall_layers * style.spacing)) continue;
    const Seen seen = camera.see(place);
    if (!seen.ahead) continue;
    const bool grey = (walls[i] && style.walls != WallStyle::coloured) || !std::isfinite(values[i]);
    const double share = high > low ? (values[i] - low) / (high - low) : 0.5;
    discs.push_back({seen.x, seen.y, radius * seen.scale, seen.depth, radius, grey ? wall_grey : map.at(share)});
  }
  Image image(style.width, style.height, paper);
  draw_discs(image, discs, frame.dimensions < 3 ? flat_shade : 1, paper);

  Canvas canvas(image);
  const double letters = layout.letters;
  canvas.text(layout.gap, 1.6 * letters, 1.15 * letters, style.title, Align::left, ink);
  const double right = style.width - layout.gap, foot = layout.legend.top + layout.legend.height;
  canvas.text(right, foot - 1.6 * letters, 1.15 * letters, "t = " + short_number(time) + " s", Align::right, ink);
  canvas.text(right, foot, 0.9 * letters, fmt::format("{} particles", frame.particles), Align::right, edge_grey);
  std::string heading = field_meaning(choice.field);
  heading += (heading.empty() ? "" : " ") + scalar_label(choice, column.components);
  if (!column.unit.empty()) heading += " [" + printed_unit(column.unit) + "]";
  draw_legend(canvas, layout.legend, map, {heading, low, high}, letters, ink);
  return canvas;
}

}  // namespace undine
