#pragma once
#include <algorithm>
#include <vector>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

/// Fluid that is on the wrong side of the walls' surfaces by more than a share of the spacing, whatever the walls are
/// made of. A box counts as it reflects: through an open face fluid may leave, and the walls beside it go on without
/// end.
template <int N>
class Leak : public Gauge<N> {
 public:
  static constexpr Info info{"leak", "How much of the fluid is behind the walls",
                             "count and share of particles with depth < -beyond spacing, or taken out of the domain; "
                             "how far the deepest is",
                             "Saalfeld (2012), table 4"};

  Leak(const Table& table, const GaugeContext<N>& context)
      : walls_(context.walls), limit_(table.in_range("beyond", unit::one, {0, 1e6}, 0.5) * context.spacing) {
    require_walls(table, context);
  }

  std::vector<SeriesColumn> columns() const override { return {{"leaked"}, {"fraction"}, {"deepest", "m"}}; }

  std::vector<double> read(const Flow<N>& flow) const override {
    const IndexRange fluid = flow.store().range(Group::fluid);
    const auto x = flow.store().template get<field::x>();
    double leaked = 0, deepest = 0;
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
      const double behind = -walls_->depth(widen(x[i]));
      if (behind > limit_) ++leaked;
      deepest = std::max(deepest, behind);
    }
    // What left the domain had leaked before.
    const auto escaped = static_cast<double>(flow.escaped()), all = static_cast<double>(fluid.size()) + escaped;
    leaked += escaped;
    return {leaked, all == 0 ? nan : leaked / all, deepest};
  }

 private:
  std::shared_ptr<const ReflectingSurface> walls_;
  double limit_;  ///< m
};

}  // namespace undine::gauges
