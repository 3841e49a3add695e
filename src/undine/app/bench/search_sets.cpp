#include "undine/app/bench/search_sets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "undine/search/pencils.hpp"

namespace undine {
namespace {

/// The same random numbers on every machine.
class Random {
 public:
  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53; }
  Vec<3> in_cube(double half_side) {
    Vec<3> x;
    for (int k = 0; k < 3; ++k) x[k] = between(-half_side, half_side);
    return x;
  }
  /// Uniform on the unit sphere.
  Vec<3> direction() {
    const double z = between(-1, 1), angle = between(0, 2 * std::numbers::pi);
    const double flat = std::sqrt(1 - z * z);
    return {{flat * std::cos(angle), flat * std::sin(angle), z}};
  }

 private:
  std::mt19937_64 bits_{1};
};

/// In spacings.
SearchSet make_uniform(int particles) {
  SearchSet set{.points = {}, .radius = 2.5};
  Random random;
  const int side = std::max(2, static_cast<int>(std::lround(std::cbrt(particles))));
  for (int a = 0; a < side; ++a)
    for (int b = 0; b < side; ++b)
      for (int c = 0; c < side; ++c) set.points.push_back(Vec<3>{{1.0 * a, 1.0 * b, 1.0 * c}} + random.in_cube(0.2));
  return set;
}

/// In radii of a cluster; the box has 20^3 for each.
SearchSet make_clustered(int particles) {
  constexpr int cluster_size = 500;
  SearchSet set{.points = {}, .radius = 0.325};
  Random random;
  const double half_side = 10 * std::cbrt(1.0 * particles / cluster_size);
  Vec<3> centre;
  for (int k = 0; k < particles; ++k) {
    if (k % cluster_size == 0) centre = random.in_cube(half_side);
    set.points.push_back(centre + random.between(0, 1) * random.direction());
  }
  return set;
}

void sort_by_space(SearchSet& set) {
  const std::span<const Vec<3>> points = set.points;
  Pencils<3> pencils;
  Workspace workspace;
  pencils.build(CellFrame<3>(box_around(points), points.size(), set.radius, Domain<3>::unbounded()), points, {},
                workspace);
  std::vector<Vec<3>> sorted;
  sorted.reserve(points.size());
  for (const auto k : pencils.order()) sorted.push_back(points[k]);
  set.points = std::move(sorted);
}

}  // namespace

SearchSet make_search_set(SearchSetKind kind, int particles) {
  SearchSet set = kind == SearchSetKind::uniform ? make_uniform(particles) : make_clustered(particles);
  sort_by_space(set);
  return set;
}

}  // namespace undine
