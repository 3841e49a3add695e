#include "undine/app/picture/legend.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace undine {
namespace {

constexpr const char* raised_digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

std::string raised(const std::string& digits) {
  std::string text;
  for (const char c : digits) text += c == '-' ? "⁻" : raised_digits[c - '0'];
  return text;
}

/// Without zeros after the point that say nothing.
std::string trimmed(std::string text) {
  if (text.find('.') == text.npos) return text;
  text.resize(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

struct Scale {
  std::vector<std::string> labels;  ///< evenly from the lowest value to the highest
  double share(std::size_t k) const { return static_cast<double>(k) / static_cast<double>(labels.size() - 1); }
};

Scale scale_of(const LegendText& text, std::size_t ticks) {
  Scale scale{std::vector<std::string>(ticks)};
  for (std::size_t k = 0; k < ticks; ++k) {
    const double value = text.low + (text.high - text.low) * scale.share(k);
    const bool zero = std::abs(value) < 1e-9 * std::max(std::abs(text.low), std::abs(text.high));
    scale.labels[k] = short_number(zero ? 0 : value, k == 0 || k == ticks - 1 ? 4 : 3);
  }
  return scale;
}

/// Five numbers, or fewer where those would run into each other.
Scale scale_for(Canvas& canvas, const LegendText& text, double size, double width) {
  for (const std::size_t ticks : {5, 3}) {
    Scale scale = scale_of(text, ticks);
    double end = 0;  // of the label before
    bool fits = true;
    for (std::size_t k = 0; k < ticks; ++k) {
      const double own = canvas.text_width(size, scale.labels[k]);
      const double begin = width * scale.share(k) - own * scale.share(k == 0 || k == ticks - 1 ? k : ticks / 2);
      fits = fits && (k == 0 || begin > end + 0.7 * size);
      end = begin + own;
    }
    if (fits) return scale;
  }
  return scale_of(text, 2);
}

}  // namespace

std::string printed_unit(const std::string& unit) {
  std::string text;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    if (unit[k] != '^') {
      text += unit[k];
      continue;
    }
    const std::size_t end = std::min(unit.find_first_not_of("-0123456789", k + 1), unit.size());
    text += raised(unit.substr(k + 1, end - k - 1));
    k = end - 1;
  }
  return text;
}

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const int power = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (power >= digits) {  // no decimals left to round
    const double unit = std::pow(10.0, power - digits + 1);
    value = std::round(value / unit) * unit;
  }
  const std::string sign = value < 0 ? "−" : "";
  if (power >= -3 && power < 6)
    return sign + trimmed(fmt::format("{:.{}f}", std::abs(value), std::max(0, digits - 1 - power)));
  const std::string text = fmt::format("{:.{}e}", std::abs(value), digits - 1);
  const std::size_t e = text.find('e');
  return sign + trimmed(text.substr(0, e)) + "·10" + raised(std::to_string(std::stoi(text.substr(e + 1))));
}

void draw_legend(Canvas& canvas, const Area& area, const ColourMap& map, const LegendText& text, double size,
                 Colour ink) {
  // Whole pixels, or else the paper would shine through between the colours.
  const double bar = std::round(area.height - 2.6 * size), top = std::round(area.top + 1.4 * size);
  const double left = std::round(area.left);
  canvas.text(area.left, area.top + 0.9 * size, size, text.heading, Align::left, ink);
  const int columns = static_cast<int>(area.width);
  for (int i = 0; i < columns; ++i) canvas.rectangle({left + i, top, 1, bar}, map.at((i + 0.5) / columns));
  const Scale scale = scale_for(canvas, text, 0.9 * size, area.width);
  const std::size_t last = scale.labels.size() - 1;
  for (std::size_t k = 0; k <= last; ++k)
    canvas.text(area.left + area.width * scale.share(k), top + bar + 1.1 * size, 0.9 * size, scale.labels[k],
                k == 0      ? Align::left
                : k == last ? Align::right
                            : Align::centre,
                ink);
}

}  // namespace undine
