#pragma once
#include <string>
#include <vector>

#include <fmt/format.h>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

/// Columns x, y, z of all fluid; with several fluids also x_NAME and so on of each.
template <int N>
class CentreOfMass : public Gauge<N> {
 public:
  static constexpr Info info{"centre_of_mass", "Centre of mass of the fluid, and of each fluid where there are several",
                             "x = sum m x / sum m", ""};

  CentreOfMass(const Table&, const GaugeContext<N>& context) {
    if (context.materials.size() > 1) names_ = context.materials;
  }

  std::vector<SeriesColumn> columns() const override {
    std::vector<SeriesColumn> all;
    for (const std::string& axis : axes<N>()) all.push_back({axis, "m"});
    for (const std::string& name : names_)
      for (const std::string& axis : axes<N>()) all.push_back({fmt::format("{}_{}", axis, name), "m"});
    return all;
  }

  std::vector<double> read(const Flow<N>& flow) const override {
    std::vector<double> row;
    for (int material = -1; material < static_cast<int>(names_.size()); ++material) {
      const Vec<N> centre = centre_of(flow, material);
      row.insert(row.end(), centre.c, centre.c + N);
    }
    return row;
  }

 private:
  static Vec<N> centre_of(const Flow<N>& flow, int material) {
    const auto x = flow.store().template get<field::x>();
    const auto m = flow.store().template get<field::m>();
    Vec<N> moment{};
    double mass = 0;
    const IndexRange fluid = flow.store().range(Group::fluid);
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
      if (material >= 0 && flow.store().materials()[i] != material) continue;
      moment += m[i] * x[i];
      mass += m[i];
    }
    return (1 / mass) * moment;  // not a number without particles
  }

  std::vector<std::string> names_;
};

}  // namespace undine::gauges
