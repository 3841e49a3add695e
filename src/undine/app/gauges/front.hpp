#pragma once
#include <algorithm>
#include <functional>
#include <vector>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

template <int N>
class Front : public Gauge<N> {
 public:
  static constexpr Info info{
      "front", "How far the fluid reaches along an axis",
      "largest (sign +) or smallest (sign -) coordinate of the fluid's particles, but for some foremost ones", ""};

  Front(const Table& table, const GaugeContext<N>&)
      : axis_(read_axis<N>(table, 0)),
        sign_(table.choice("sign", {"+", "-"}, "+") == "+" ? 1 : -1),
        ignore_(table.integer("ignore", 0)) {
    if (ignore_ < 0) table.fail("ignore", "'ignore' is a number of particles", "it is negative", "give 0 or more");
  }

  std::vector<SeriesColumn> columns() const override { return {{"front", "m"}}; }

  std::vector<double> read(const Flow<N>& flow) const override {
    const IndexRange fluid = flow.store().range(Group::fluid);
    const auto ignored = static_cast<std::size_t>(ignore_);
    if (ignored >= fluid.size()) return {nan};
    const auto x = flow.store().template get<field::x>();
    std::vector<double> reach;
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) reach.push_back(sign_ * flow.domain().wrapped(x[i])[axis_]);
    const auto front = reach.begin() + static_cast<std::ptrdiff_t>(ignored);
    std::nth_element(reach.begin(), front, reach.end(), std::greater<>());
    return {sign_ * *front};
  }

 private:
  int axis_;
  double sign_;
  std::int64_t ignore_;
};

}  // namespace undine::gauges
