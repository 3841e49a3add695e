#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "undine/app/gauges/gauge.hpp"
#include "undine/search/cell_grid.hpp"

namespace undine::gauges {

/// Fluid particles that have come to lie on one another, as a pressure force that vanishes at r = 0 lets them.
template <int N>
class Coincidence : public Gauge<N> {
 public:
  static constexpr Info info{"coincidence", "Pairs of fluid particles that nearly coincide",
                             "pairs with r < closer_than spacing; smallest r / spacing, seen up to 1.5",
                             "Saalfeld (2012), 8.2: particles in one place"};

  Coincidence(const Table& table, const GaugeContext<N>& context)
      : spacing_(context.spacing), limit_(table.in_range("closer_than", unit::one, {0, seen}, 0.1) * context.spacing) {}

  std::vector<SeriesColumn> columns() const override { return {{"pairs"}, {"closest"}}; }

  std::vector<double> read(const Flow<N>& flow) const override {
    const IndexRange fluid = flow.store().range(Group::fluid);
    const auto x = flow.store().template get<field::x>().subspan(fluid.begin, fluid.size());
    CellGrid<N> grid;
    grid.build(x, seen * spacing_, flow.domain());
    double pairs = 0, closest = seen * spacing_;
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < x.size(); ++i) {
      grid.find(x[i], closest, found);
      for (const std::uint32_t j : found)
        if (j > i) closest = std::min(closest, norm(flow.domain().nearest_image(x[i] - x[j])));
      grid.find(x[i], limit_, found);
      pairs += static_cast<double>(std::ranges::count_if(found, [&](std::uint32_t j) { return j > i; }));
    }
    return {pairs, closest / spacing_};
  }

 private:
  static constexpr double seen = 1.5;  ///< spacings
  double spacing_, limit_;             ///< m
};

}  // namespace undine::gauges
