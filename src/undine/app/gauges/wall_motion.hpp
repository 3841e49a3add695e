#pragma once
#include <cmath>
#include <vector>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

/// How much the fluid beside the walls still moves: at rest this is the walls' own jitter.
template <int N>
class WallJitter : public Gauge<N> {
 public:
  static constexpr Info info{"wall_motion", "RMS speed of the fluid near the walls",
                             "sqrt(sum m |v|^2 / sum m) over the fluid within a distance of a wall's surface",
                             "Saalfeld (2012), 7.3: particles that tremble at the wall"};

  WallJitter(const Table& table, const GaugeContext<N>& context) : walls_(context.walls) {
    require_walls(table, context);
    within_ = context.support > 0 ? table.positive("within", unit::length, context.support)
                                  : table.positive("within", unit::length);
  }

  std::vector<SeriesColumn> columns() const override { return {{"speed", "m/s"}, {"particles"}}; }

  std::vector<double> read(const Flow<N>& flow) const override {
    const IndexRange fluid = flow.store().range(Group::fluid);
    const auto x = flow.store().template get<field::x>();
    const auto v = flow.store().template get<field::v>();
    const auto m = flow.store().template get<field::m>();
    double mass = 0, sum = 0, count = 0;
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
      if (!(std::abs(walls_->depth(widen(x[i]))) < within_)) continue;
      mass += m[i];
      sum += m[i] * norm_sq(v[i]);
      ++count;
    }
    return {count > 0 ? std::sqrt(sum / mass) : nan, count};
  }

 private:
  std::shared_ptr<const ReflectingSurface> walls_;
  double within_ = 0;  ///< m
};

}  // namespace undine::gauges
