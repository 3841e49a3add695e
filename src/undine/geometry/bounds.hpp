#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "undine/core/vec.hpp"

namespace undine {

using Vec3 = Vec<3, double>;

inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// An axis-aligned box [lo, hi] in metres; +-infinity where it has no end.
/// The default is empty (lo > hi), so that it grows from nothing.
struct Bounds {
  Vec3 lo{{unbounded, unbounded, unbounded}};
  Vec3 hi{{-unbounded, -unbounded, -unbounded}};

  static Bounds everything() { return {{{-unbounded, -unbounded, -unbounded}}, {{unbounded, unbounded, unbounded}}}; }

  void include(const Vec3& p) {
    for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
  }
  void include(const Bounds& other) { include(other.lo), include(other.hi); }

  bool empty() const { return lo[0] > hi[0] || lo[1] > hi[1] || lo[2] > hi[2]; }

  /// Strictly inside, so false on a face.
  bool holds(const Vec3& p) const {
    return (p[0] > lo[0]) && (p[0] < hi[0]) && (p[1] > lo[1]) && (p[1] < hi[1]) && (p[2] > lo[2]) && (p[2] < hi[2]);
  }

  /// True when the segment lies beyond one and the same face, so that it cannot meet the box.
  bool clear_of(const Vec3& from, const Vec3& to) const {
    for (int k = 0; k < 3; ++k) {
      if ((from[k] < lo[k] && to[k] < lo[k]) || (from[k] > hi[k] && to[k] > hi[k])) return true;
    }
    return false;
  }

  /// The largest finite coordinate or extent, in metres: the scale that rounding errors relate to.
  double scale() const {
    double s = 0;
    for (int k = 0; k < 3; ++k) {
      for (const double x : {lo[k], hi[k], hi[k] - lo[k]}) {
        if (std::isfinite(x)) s = std::max(s, std::abs(x));
      }
    }
    return s;
  }
};

/// What two boxes share; empty when they are apart.
inline Bounds overlap(const Bounds& a, const Bounds& b) {
  Bounds both;
  for (int k = 0; k < 3; ++k) both.lo[k] = std::max(a.lo[k], b.lo[k]), both.hi[k] = std::min(a.hi[k], b.hi[k]);
  return both;
}

}  // namespace undine
