#pragma once
#include <string>
#include <vector>

#include "undine/app/gauges/gauge.hpp"
#include "undine/engine/interpolate.hpp"

namespace undine::gauges {

template <int N>
class Probe : public Gauge<N> {
 public:
  static constexpr Info info{"probe", "Pressure, velocity or density at a point",
                             "f(x) = sum_b V_b f_b W_b / sum_b V_b W_b; 0 where sum_b V_b W_b < wet", "Shepard (1968)"};

  Probe(const Table& table, const GaugeContext<N>& context)
      : at_(read_point<N>(table, "at")),
        fields_(table.choices("fields", {"pressure", "velocity", "density"}, {"pressure"})),
        shepard_(table.flag("shepard", true)),
        wet_(table.in_range("wet", unit::one, {0, 1}, 0.1)) {
    if (!context.domain.contains(at_))
      table.fail("at", "the probe is outside the domain", "no particle can come there", "move it, or widen [domain]");
    if (fields_.empty()) table.fail("fields", "the probe reads nothing", {}, "name a field, such as \"pressure\"");
  }

  std::vector<SeriesColumn> columns() const override {
    std::vector<SeriesColumn> all;
    for (const std::string& field : fields_) {
      if (field == "pressure") all.push_back({"p", "Pa"});
      if (field == "density") all.push_back({"rho", "kg/m^3"});
      if (field == "velocity")
        for (const std::string& axis : axes<N>()) all.push_back({"v" + axis, "m/s"});
    }
    return all;
  }

  std::vector<double> read(const Flow<N>& flow) const override {
    Interpolated<N> here = interpolate(flow.interpolation_source(), at_);
    if (here.weight < wet_) here = {};  // a sensor in the air, with a drop on it at most
    const double scale = shepard_ ? 1 : here.weight;
    std::vector<double> row;
    for (const std::string& field : fields_) {
      if (field == "pressure") row.push_back(scale * here.p);
      if (field == "density") row.push_back(scale * here.rho);
      if (field == "velocity")
        for (int k = 0; k < N; ++k) row.push_back(scale * here.v[k]);
    }
    return row;
  }

 private:
  Vec<N> at_;
  std::vector<std::string> fields_;
  bool shepard_;
  double wet_;
};

}  // namespace undine::gauges
