#pragma once
#include <array>
#include <filesystem>
#include <vector>

#include "undine/app/gauges/gauge.hpp"

namespace undine::gauges {

/// A component of the velocity along a line, at the places of a published profile, and how far it is from it.
template <int N>
class Profile : public Gauge<N> {
 public:
  static constexpr Info info{
      "profile", "Velocity along a line, against a published profile",
      "f_k = v(from + s_k (to - from)) by interpolation exact for linear fields; L2 = sqrt(sum_k (f_k - g_k)^2 / n), "
      "L2_relative = sqrt(sum_k (f_k - g_k)^2 / sum_k g_k^2), Linf = max_k |f_k - g_k|",
      "Liu & Liu (2006)"};

  Profile(const Table& table, const GaugeContext<N>& context);

  std::vector<SeriesColumn> columns() const override;
  std::vector<double> read(const Flow<N>& flow) const override;

 private:
  void read_profile(const Table& table);
  /// Rows of the file whose other columns have the values that the case asks for.
  std::vector<bool> chosen_rows(const Table& table, const CsvTable& data) const;

  struct Point {
    double share;  ///< of the way from `from` to `to`
    double value;  ///< published, m/s
  };
  Vec<N> from_, to_;
  int component_ = 0;
  std::vector<Point> points_;
};

extern template class Profile<1>;
extern template class Profile<2>;
extern template class Profile<3>;

}  // namespace undine::gauges
