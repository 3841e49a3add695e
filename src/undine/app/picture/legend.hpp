#pragma once
#include <string>

#include "undine/app/picture/canvas.hpp"
#include "undine/app/picture/colour_map.hpp"

namespace undine {

struct LegendText {
  std::string heading;  ///< what the colours show, with its unit
  double low = 0, high = 0;
};

/// A bar of colours with five numbers under it and its heading above.
void draw_legend(Canvas& canvas, const Area& area, const ColourMap& map, const LegendText& text, double size,
                 Colour ink);

/// A number for people: four digits, powers of ten where they are long.
std::string short_number(double value, int digits = 4);
/// "kg/m³" of "kg/m^3".
std::string printed_unit(const std::string& unit);

}  // namespace undine
