#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "undine/app/gauges/gauge.hpp"
#include "undine/engine/interpolate.hpp"

namespace undine::gauges {

/// A point is wet where the fluid fills more than half of that part of the kernel which walls leave free:
///   sum V W (fluid) > 1/2 share,  share = 1 - sum V W (walls)
/// so that the surface of still water is found where it is, also next to walls, where the kernel can never be full.
/// Walls without (enough) particles are seen by the column's end alone: within H/2 of `from`, the share is at most
/// 1/2 + s/H at distance s. Still water reads its depth within 0.5 spacings. A point is inside a wall, and dry, if the
/// walls take 0.8 of the kernel: an edge between two walls takes 3/4. In a corner of three (7/8) the wetted length is
/// therefore up to 0.75 spacings short.
template <int N>
class Height : public Gauge<N> {
 public:
  static constexpr Info info{
      "height", "Height of water along a column",
      "wetted: summed length where sum_b V_b W_b > share/2; surface: where the highest such part ends",
      "threshold at the middle of a flat surface"};

  Height(const Table& table, const GaugeContext<N>& context) : at_(read_point<N>(table, "at")) {
    axis_ = read_axis<N>(table, steepest_axis(context.gravity));
    const bool down = context.gravity[axis_] > 0;  // gravity along +axis: the column rises along -axis
    from_ = read_end(table, "from", down ? context.domain.high[axis_] : context.domain.low[axis_]);
    to_ = read_end(table, "to", down ? context.domain.low[axis_] : context.domain.high[axis_]);
    const double intervals = std::ceil(std::abs(to_ - from_) / (context.spacing / 4));
    if (!(intervals > 0 && intervals < 1e6))
      table.fail(
          "to", "the column has no sensible length",
          fmt::format("it is {:.6g} m long, the particles are {:.6g} m apart", std::abs(to_ - from_), context.spacing),
          "give the two ends of the column, 'from' and 'to'");
    intervals_ = static_cast<std::size_t>(intervals);
    surface_ = table.choice("mode", {"wetted", "surface"}, "wetted") == "surface";
  }

  std::vector<SeriesColumn> columns() const override { return {{"height", "m"}}; }

  std::vector<double> read(const Flow<N>& flow) const override {
    const auto source = flow.interpolation_source();
    const double step = std::abs(to_ - from_) / static_cast<double>(intervals_);
    double wetted = 0, surface = 0;
    const bool ghosts = flow.options().mirrors != nullptr;
    double below = wetness(source, 0, ghosts);
    for (std::size_t k = 1; k <= intervals_; ++k) {
      const double s = step * static_cast<double>(k);
      const double above = wetness(source, s, ghosts);
      const double crossing = (below > 0) != (above > 0) ? step * below / (below - above) : 0;  // from the lower end
      if (below > 0) {
        wetted += above > 0 ? step : crossing;
        surface = above > 0 ? s : s - step + crossing;
      } else if (above > 0) {
        wetted += step - crossing;
        surface = s;
      }
      below = above;
    }
    return {surface_ ? surface : wetted};
  }

 private:
  static double read_end(const Table& table, std::string_view key, double fallback) {
    return std::isfinite(fallback) ? table.quantity(key, unit::length, fallback) : table.quantity(key, unit::length);
  }

  /// Positive where the point at distance s from `from` is wet.
  double wetness(const InterpolationSource<N>& source, double s, bool ghosts) const {
    Vec<N> x = at_;
    x[axis_] = from_ + std::copysign(s, to_ - from_);
    const double walls = wall_share(source, x);
    // Ghosts go on where the fluid does: with them the kernel is as full at a wall as elsewhere.
    if (ghosts) return fluid_share(source, x) + walls - 0.5 * std::min(1.0, 0.5 + s / source.support.uniform);
    if (walls > 0.8) return -0.5;
    const double share = std::min(1 - walls, 0.5 + s / source.support.uniform);
    return fluid_share(source, x) - 0.5 * share;
  }

  Vec<N> at_;
  int axis_ = 0;
  double from_ = 0, to_ = 0;
  std::size_t intervals_ = 0;
  bool surface_ = false;
};

}  // namespace undine::gauges
