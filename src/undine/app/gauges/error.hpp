#pragma once
#include <array>
#include <string>
#include <vector>

#include "undine/analysis/exact/catalogue.hpp"
#include "undine/app/gauges/gauge.hpp"
#include "undine/geometry/shape.hpp"

namespace undine {

/// How far the fluid is from an exact solution.
template <int N>
class ErrorGauge : public Gauge<N> {
 public:
  static constexpr Info info{
      "error", "Distance of the fluid from an exact solution, over its particles",
      "L1 = sum_i V_i |f_i - f(x_i, t)| / sum_i V_i, L2 = sqrt(sum_i V_i |f_i - f(x_i, t)|^2 / sum_i V_i), "
      "Linf = max_i |f_i - f(x_i, t)|, L2_relative = L2 / sqrt(sum_i V_i |f(x_i, t)|^2 / sum_i V_i), V = m/rho",
      ""};

  ErrorGauge(const Table& table, const GaugeContext<N>& context);

  std::vector<SeriesColumn> columns() const override;
  std::vector<double> read(const Flow<N>& flow) const override;

 private:
  /// What is compared: pressure, density, internal energy, the velocity as a vector, or one component of it.
  struct Field {
    std::string name, column, unit;
    int component = -1;
  };
  static constexpr std::size_t most_fields = 4 + N;

  void read_solution(const Table& table);
  void read_axes(const Table& table, const GaugeContext<N>& context);
  void read_fields(const Table& table);

  exact::ExactSolution solution_;
  Vec<N> origin_{};
  std::array<Vec<N>, 2> axes_{};  ///< unit vectors of the case: the solution's x and y
  std::vector<Field> fields_;
  ShapePtr region_;  ///< none: everywhere
  double time_shift_ = 0;
  bool without_mean_pressure_ = false;
};

extern template class ErrorGauge<1>;
extern template class ErrorGauge<2>;
extern template class ErrorGauge<3>;

}  // namespace undine
