#pragma once
#include <span>

#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// Reference points of the steady flow in a square cavity under a moving lid, unit side and unit speed of the lid.
struct Cavity {
  static constexpr Info info{
      "cavity", "Lid-driven square cavity, steady: reference points on the centre lines (a table, no formula)",
      "v_x on x = 0.5 at y = s, v_y on y = 0.5 at x = s; lid y = 1 moves with 1; between the 17 points of each line "
      "monotone cubics",
      "Ghia, Ghia and Shin (1982), tables I and II, three misprints corrected (validation/cavity)"};
  static constexpr Frame frame = Frame::time;  // two lines, not a field in space
  static constexpr std::array coordinates{std::string_view("s")};
  static constexpr std::array fields{FieldLine{"velocity_x", "1"}, FieldLine{"velocity_y", "1"}};
  static constexpr Example example{{{0.0}}, {{1.0}}, 0};

  double Re = 1000;
  static constexpr auto parameters() {
    return std::array{
        Parameter<Cavity>{"reynolds", &Cavity::Re, "1", "100, 400, 1000, 3200, 5000, 7500 or 10000", 100, 10000}};
  }

  static std::span<const double> reynolds();
  /// Where the tables have points, ascending.
  static std::span<const double> places_of_x(), places_of_y();

  struct Profiles {
    std::size_t column;
    Values<2> operator()(const Point& s) const;
  };
  Profiles at(double) const;
};

}  // namespace undine::exact
