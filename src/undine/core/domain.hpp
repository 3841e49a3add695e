#pragma once
#include <cmath>
#include <limits>

#include "undine/core/vec.hpp"

namespace undine {

/// The region that particles may be in. Along a periodic axis the region repeats; elsewhere its bounds only say what
/// "escaped" means.
template <int N>
struct Domain {
  Vec<N> low, high;
  bool periodic[N]{};

  static Domain unbounded() {
    Domain d;
    for (int k = 0; k < N; ++k) {
      d.low[k] = -std::numeric_limits<double>::infinity();
      d.high[k] = std::numeric_limits<double>::infinity();
    }
    return d;
  }

  bool any_periodic() const {
    for (int k = 0; k < N; ++k)
      if (periodic[k]) return true;
    return false;
  }

  double length(int axis) const { return high[axis] - low[axis]; }

  /// The shortest vector between two points that differ by d, over all periodic images.
  Vec<N> nearest_image(Vec<N> d) const {
    for (int k = 0; k < N; ++k)
      if (periodic[k]) d[k] -= length(k) * std::nearbyint(d[k] / length(k));
    return d;
  }

  /// The image of x inside the region (periodic axes only).
  Vec<N> wrapped(Vec<N> x) const {
    for (int k = 0; k < N; ++k)
      if (periodic[k]) x[k] -= length(k) * std::floor((x[k] - low[k]) / length(k));
    return x;
  }

  /// Whether x is within the bounds of every axis that is not periodic.
  bool contains(const Vec<N>& x) const {
    for (int k = 0; k < N; ++k)
      if (!periodic[k] && !(x[k] >= low[k] && x[k] <= high[k])) return false;
    return true;
  }
};

}  // namespace undine
