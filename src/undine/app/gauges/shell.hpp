#pragma once
#include <algorithm>
#include <vector>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

/// Where a wave that runs away from a point has got to.
template <int N>
class Shell : public Gauge<N> {
 public:
  static constexpr Info info{
      "shell", "Where the fluid is densest around a point: the place of a blast wave",
      "rho_k = sum m / sum m/rho over the particles with k <= r/width < k + 1; the vertex of the parabola through the "
      "largest rho_k and the two beside it, at the middles of the shells; front: where a straight line through the "
      "rho_k falls to the mean of largest and outermost",
      ""};

  Shell(const Table& table, const GaugeContext<N>& context)
      : centre_(read_point<N>(table, "centre", Vec<N>{})),
        width_(table.positive("width", unit::length, 0.5 * context.spacing)) {}

  std::vector<SeriesColumn> columns() const override {
    return {{"radius", "m"}, {"density", "kg/m^3"}, {"front", "m"}};
  }

  std::vector<double> read(const Flow<N>& flow) const override {
    const auto shells = shells_of(flow);
    const auto top = std::ranges::max_element(shells, {}, &Mean::density);
    if (top == shells.end()) return {nan, nan, nan};
    double radius = top->radius, density = top->density;
    const auto place = top - shells.begin();
    if (place > 0 && top + 1 != shells.end()) {
      const double before = (top - 1)->density, after = (top + 1)->density;
      const double bend = before - 2 * density + after, slope = 0.5 * (after - before);
      if (bend < 0) {
        radius -= slope / bend * width_;
        density -= 0.5 * slope * slope / bend;
      }
    }
    const double middle = 0.5 * (top->density + shells.back().density);
    const auto beyond = std::find_if(top, shells.end(), [&](const Mean& shell) { return shell.density < middle; });
    if (beyond == top || beyond == shells.end()) return {radius, density, nan};
    const Mean &inner = *(beyond - 1), &outer = *beyond;
    const double share = (inner.density - middle) / (inner.density - outer.density);
    return {radius, density, inner.radius + share * (outer.radius - inner.radius)};
  }

 private:
  struct Mean {
    double radius, density;
  };

  /// The shells that hold particles, outwards.
  std::vector<Mean> shells_of(const Flow<N>& flow) const {
    const auto x = flow.store().template get<field::x>();
    const auto m = flow.store().template get<field::m>();
    const auto rho = flow.store().template get<field::rho>();
    const IndexRange fluid = flow.store().range(Group::fluid);
    std::vector<double> mass, volume;
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
      const auto k = static_cast<std::size_t>(norm(flow.domain().nearest_image(x[i] - centre_)) / width_);
      if (k >= mass.size()) {
        mass.resize(k + 1);
        volume.resize(k + 1);
      }
      mass[k] += m[i];
      volume[k] += m[i] / rho[i];
    }
    std::vector<Mean> shells;
    for (std::size_t k = 0; k < mass.size(); ++k)
      if (mass[k] > 0) shells.push_back({(static_cast<double>(k) + 0.5) * width_, mass[k] / volume[k]});
    return shells;
  }

  Vec<N> centre_;
  double width_;
};

}  // namespace undine::gauges
