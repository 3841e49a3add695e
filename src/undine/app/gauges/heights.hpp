#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

/// Where particles lie along an axis; each is spread over one spacing, so that a lattice is a uniform column.
struct HeightProfile {
  std::vector<double> z, m;  ///< m, kg
  double spacing = 0;        ///< m

  double mass() const {
    double sum = 0;
    for (const double each : m) sum += each;
    return sum;
  }

  /// Mass below the height, kg.
  double below(double height) const {
    double sum = 0;
    for (std::size_t k = 0; k < z.size(); ++k) sum += m[k] * std::clamp((height - z[k]) / spacing + 0.5, 0.0, 1.0);
    return sum;
  }

  /// Height below which the share of the mass lies; NaN without particles.
  double quantile(double share) const {
    if (z.empty()) return nan;
    const auto [low, high] = std::ranges::minmax(z);
    double under = low - spacing, over = high + spacing;
    const double wanted = share * mass();
    for (int step = 0; step < 50; ++step) {
      const double middle = 0.5 * (under + over);
      (below(middle) < wanted ? under : over) = middle;
    }
    return 0.5 * (under + over);
  }
};

/// The fluid's particles of one material (all: -1) along an axis; `up` is 1 or -1.
template <int N>
HeightProfile profile_of(const Flow<N>& flow, int material, int axis, double up, double spacing) {
  HeightProfile profile{{}, {}, spacing};
  const IndexRange fluid = flow.store().range(Group::fluid);
  const auto x = flow.store().template get<field::x>();
  const auto m = flow.store().template get<field::m>();
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    if (material >= 0 && flow.store().materials()[i] != material) continue;
    profile.z.push_back(up * x[i][axis]);
    profile.m.push_back(m[i]);
  }
  return profile;
}

}  // namespace undine::gauges
