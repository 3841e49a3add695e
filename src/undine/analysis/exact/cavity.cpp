#include "undine/analysis/exact/cavity.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "undine/core/error.hpp"

namespace undine::exact {
namespace {

constexpr std::array<double, 7> numbers{100, 400, 1000, 3200, 5000, 7500, 10000};

struct Row {
  double s;
  double value[numbers.size()];  ///< by Reynolds number
};

// Ghia, Ghia and Shin (1982) as printed, but for: v_x(Re 3200, y 0.4531) = -0.86636, which lacks a 0 after the point;
// v_x(Re 10000, y 0.5) = 0.03111, which lacks its sign; v_y(Re 400, x 0.9063) = -0.23827, which breaks the curve and
// stands here as -0.38969 of an independent solution (validation/cavity).
// clang-format off
constexpr Row velocity_x[]{
    {0.0000, {0.00000, 0.00000, 0.00000, 0.00000, 0.00000, 0.00000, 0.00000}},
    {0.0547, {-0.03717, -0.08186, -0.18109, -0.32407, -0.41165, -0.43154, -0.42735}},
    {0.0625, {-0.04192, -0.09266, -0.20196, -0.35344, -0.42901, -0.43590, -0.42537}},
    {0.0703, {-0.04775, -0.10338, -0.22220, -0.37827, -0.43643, -0.43025, -0.41657}},
    {0.1016, {-0.06434, -0.14612, -0.29730, -0.41933, -0.40435, -0.38324, -0.38000}},
    {0.1719, {-0.10150, -0.24299, -0.38289, -0.34323, -0.33050, -0.32393, -0.32709}},
    {0.2813, {-0.15662, -0.32726, -0.27805, -0.24427, -0.22855, -0.23176, -0.23186}},
    {0.4531, {-0.21090, -0.17119, -0.10648, -0.08664, -0.07404, -0.07503, -0.07540}},
    {0.5000, {-0.20581, -0.11477, -0.06080, -0.04272, -0.03039, -0.03800, -0.03111}},
    {0.6172, {-0.13641, 0.02135, 0.05702, 0.07156, 0.08183, 0.08342, 0.08344}},
    {0.7344, {0.00332, 0.16256, 0.18719, 0.19791, 0.20087, 0.20591, 0.20673}},
    {0.8516, {0.23151, 0.29093, 0.33304, 0.34682, 0.33556, 0.34228, 0.34635}},
    {0.9531, {0.68717, 0.55892, 0.46604, 0.46101, 0.46036, 0.47167, 0.47804}},
    {0.9609, {0.73722, 0.61756, 0.51117, 0.46547, 0.45992, 0.47323, 0.48070}},
    {0.9688, {0.78871, 0.68439, 0.57492, 0.48296, 0.46120, 0.47048, 0.47783}},
    {0.9766, {0.84123, 0.75837, 0.65928, 0.53236, 0.48223, 0.47244, 0.47221}},
    {1.0000, {1.00000, 1.00000, 1.00000, 1.00000, 1.00000, 1.00000, 1.00000}},
};
constexpr Row velocity_y[]{
    {0.0000, {0.00000, 0.00000, 0.00000, 0.00000, 0.00000, 0.00000, 0.00000}},
    {0.0625, {0.09233, 0.18360, 0.27485, 0.39560, 0.42447, 0.43979, 0.43983}},
    {0.0703, {0.10091, 0.19713, 0.29012, 0.40917, 0.43329, 0.44030, 0.43733}},
    {0.0781, {0.10890, 0.20920, 0.30353, 0.41906, 0.43648, 0.43564, 0.43124}},
    {0.0938, {0.12317, 0.22965, 0.32627, 0.42768, 0.42951, 0.41824, 0.41487}},
    {0.1563, {0.16077, 0.28124, 0.37095, 0.37119, 0.35368, 0.35060, 0.35070}},
    {0.2266, {0.17507, 0.30203, 0.33075, 0.29030, 0.28066, 0.28117, 0.28003}},
    {0.2344, {0.17527, 0.30174, 0.32235, 0.28188, 0.27280, 0.27348, 0.27224}},
    {0.5000, {0.05454, 0.05186, 0.02526, 0.00999, 0.00945, 0.00824, 0.00831}},
    {0.8047, {-0.24533, -0.38598, -0.31966, -0.31184, -0.30018, -0.30448, -0.30719}},
    {0.8594, {-0.22445, -0.44993, -0.42665, -0.37401, -0.36214, -0.36213, -0.36737}},
    {0.9063, {-0.16914, -0.38969, -0.51550, -0.44307, -0.41442, -0.41050, -0.41496}},
    {0.9453, {-0.10313, -0.22847, -0.39188, -0.54053, -0.52876, -0.48590, -0.45863}},
    {0.9531, {-0.08864, -0.19254, -0.33714, -0.52357, -0.55408, -0.52347, -0.49099}},
    {0.9609, {-0.07391, -0.15663, -0.27669, -0.47425, -0.55069, -0.55216, -0.52987}},
    {0.9688, {-0.05906, -0.12146, -0.21388, -0.39017, -0.49774, -0.53858, -0.54302}},
    {1.0000, {0.00000, 0.00000, 0.00000, 0.00000, 0.00000, 0.00000, 0.00000}},
};
// clang-format on

template <std::size_t n>
std::vector<double> places(const Row (&rows)[n]) {
  std::vector<double> all;
  for (const Row& row : rows) all.push_back(row.s);
  return all;
}

/// Slope at point k that keeps the curve monotone between points. Fritsch and Butland (1984), eq. 2.
template <std::size_t n>
double slope(const Row (&rows)[n], std::size_t k, std::size_t column) {
  const auto secant = [&](std::size_t i) {
    return (rows[i + 1].value[column] - rows[i].value[column]) / (rows[i + 1].s - rows[i].s);
  };
  if (k == 0) return secant(0);
  if (k == n - 1) return secant(n - 2);
  const double a = secant(k - 1), b = secant(k);
  if (a * b <= 0) return 0;
  const double left = rows[k].s - rows[k - 1].s, right = rows[k + 1].s - rows[k].s;
  const double share = (1 + right / (left + right)) / 3;
  return a * b / (share * b + (1 - share) * a);
}

template <std::size_t n>
double interpolated(const Row (&rows)[n], double s, std::size_t column) {
  const Row* above = std::ranges::lower_bound(rows, std::clamp(s, 0.0, 1.0), {}, &Row::s);
  const auto k = static_cast<std::size_t>(above - rows);
  if (k == 0 || above->s == s) return above->value[column];
  const Row &a = rows[k - 1], &b = rows[k];
  const double length = b.s - a.s, f = (std::clamp(s, 0.0, 1.0) - a.s) / length;
  return sq(1 - f) * ((1 + 2 * f) * a.value[column] + f * length * slope(rows, k - 1, column)) +
         sq(f) * ((3 - 2 * f) * b.value[column] - (1 - f) * length * slope(rows, k, column));
}

}  // namespace

std::span<const double> Cavity::reynolds() { return numbers; }
std::span<const double> Cavity::places_of_x() {
  static const std::vector<double> all = places(velocity_x);
  return all;
}
std::span<const double> Cavity::places_of_y() {
  static const std::vector<double> all = places(velocity_y);
  return all;
}

auto Cavity::at(double) const -> Profiles {
  const auto found = std::ranges::find(numbers, Re);
  if (found == numbers.end())
    throw InputError({.what = fmt::format("the table has no Reynolds number {}", Re),
                      .fix = "give one of 100, 400, 1000, 3200, 5000, 7500, 10000"});
  return {static_cast<std::size_t>(found - numbers.begin())};
}

Values<2> Cavity::Profiles::operator()(const Point& s) const {
  return {interpolated(velocity_x, s[0], column), interpolated(velocity_y, s[0], column)};
}

}  // namespace undine::exact
