#pragma once
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "undine/app/gauges/heights.hpp"

namespace undine::gauges {

/// The density of a body of fluid in two ways: what its particles carry, and its mass over the room that it takes.
/// The room is base times height. The height must neither see a drop in the air nor the roughness of the surface, so it
/// is read off the mass below each level: where the straight line through the levels with 50 % and 90 % of the mass
/// below them reaches 100 %. A uniform column gives its height exactly; [S] does not say how his was read.
template <int N>
class MeanDensity : public Gauge<N> {
 public:
  static constexpr Info info{"mean_density", "Mean density carried by the particles, and by the room they take",
                             "carried = sum rho / n; occupied = sum m / (base height), "
                             "height = z_90% + (z_90% - z_50%) (1 - 0.9)/(0.9 - 0.5) - floor",
                             "Saalfeld (2012), 8.1"};

  MeanDensity(const Table& table, const GaugeContext<N>& context)
      : spacing_(context.spacing), axis_(read_axis<N>(table, steepest_axis(context.gravity))) {
    up_ = context.gravity[axis_] > 0 ? -1 : 1;
    double base = 1;
    for (int k = 0; k < N; ++k) {
      if (k == axis_) continue;
      base *= context.domain.periodic[k] ? context.domain.length(k) : context.container.hi[k] - context.container.lo[k];
    }
    const double floor = up_ > 0 ? context.container.lo[axis_] : -context.container.hi[axis_];
    const Dimension area = N == 3 ? unit::area : N == 2 ? unit::length : unit::one;
    base_ = std::isfinite(base) && base > 0 ? table.positive("base", area, base) : table.positive("base", area);
    floor_ = std::isfinite(floor) ? up_ * table.quantity("floor", unit::length, up_ * floor)
                                  : up_ * table.quantity("floor", unit::length);
  }

  std::vector<SeriesColumn> columns() const override {
    return {{"carried", "kg/m^3"}, {"occupied", "kg/m^3"}, {"height", "m"}};
  }

  std::vector<double> read(const Flow<N>& flow) const override {
    const IndexRange fluid = flow.store().range(Group::fluid);
    if (fluid.size() == 0) return {nan, nan, nan};
    const auto rho = flow.store().template get<field::rho>();
    const double carried = total_over(flow.store(), Group::fluid, [&](std::size_t i) { return rho[i]; }) /
                           static_cast<double>(fluid.size());
    const HeightProfile profile = profile_of(flow, -1, axis_, up_, spacing_);
    const double middle = profile.quantile(0.5), high = profile.quantile(0.9);
    const double height = high + (high - middle) * (1 - 0.9) / (0.9 - 0.5) - floor_;
    return {carried, profile.mass() / (base_ * height), height};
  }

 private:
  double spacing_;
  int axis_;
  double up_ = 1, base_ = 1, floor_ = 0;  ///< m^(N-1); m, upwards
};

}  // namespace undine::gauges
