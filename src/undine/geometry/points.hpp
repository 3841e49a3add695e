#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "undine/geometry/bounds.hpp"

namespace undine {

/// Particles from a file: a point and one value per named column each.
struct PointTable {
  std::vector<Vec3> points;                  ///< m; unused coordinates are 0
  std::vector<std::string> names;            ///< columns other than x, y, z, in the file's order
  std::vector<std::vector<double>> columns;  ///< columns[k] belongs to names[k]; one value per point, SI units

  /// The column of that name, or null.
  const std::vector<double>* find(const std::string& name) const;
};

/// Read comma-separated values: one header line with x, y, z (as many as dimensions) and any further names, then one
/// line per particle. Blank lines and lines that start with # are skipped. InputError with line and column (counted
/// in fields) for a missing, repeated or unknown coordinate, a wrong number of fields, or a value that is no finite
/// number.
PointTable load_points_csv(const std::string& path, int dimensions);

/// Two points that are too close.
struct Overlap {
  std::size_t a = 0;
  std::size_t b = 0;
  double distance = 0;  ///< m
};

/// The closest pair of a point of `a` and a point of `b` less than `min_distance` (m) apart; of equal ones the first.
/// Takes time proportional to the number of points.
std::optional<Overlap> check_overlap(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double min_distance);

/// The same among the points of one list (a < b).
std::optional<Overlap> check_overlap(const std::vector<Vec3>& points, double min_distance);

}  // namespace undine
