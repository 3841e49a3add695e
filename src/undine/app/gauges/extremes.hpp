#pragma once
#include <limits>
#include <vector>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

template <int N>
class Extremes : public Gauge<N> {
 public:
  static constexpr Info info{"extremes", "Largest speed; smallest and largest density and pressure of the fluid",
                             "max |v|, min rho, max rho, min p, max p", ""};

  Extremes(const Table&, const GaugeContext<N>&) {}

  std::vector<SeriesColumn> columns() const override {
    return {{"v_max", "m/s"}, {"rho_min", "kg/m^3"}, {"rho_max", "kg/m^3"}, {"p_min", "Pa"}, {"p_max", "Pa"}};
  }

  std::vector<double> read(const Flow<N>& flow) const override {
    if (flow.store().range(Group::fluid).size() == 0) return {nan, nan, nan, nan, nan};
    const auto v = flow.store().template get<field::v>();
    const auto rho = flow.store().template get<field::rho>();
    const auto p = flow.store().template get<field::p>();
    const auto largest = [&](auto&& f) {
      return largest_over(flow.store(), Group::fluid, -std::numeric_limits<double>::infinity(), f);
    };
    return {largest([&](std::size_t i) { return norm(v[i]); }), -largest([&](std::size_t i) { return -rho[i]; }),
            largest([&](std::size_t i) { return rho[i]; }), -largest([&](std::size_t i) { return -p[i]; }),
            largest([&](std::size_t i) { return p[i]; })};
  }
};

}  // namespace undine::gauges
