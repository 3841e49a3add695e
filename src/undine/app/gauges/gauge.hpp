#pragma once
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "undine/core/catalogue.hpp"
#include "undine/geometry/embed.hpp"
#include "undine/geometry/surface.hpp"
#include "undine/io/case/table.hpp"
#include "undine/io/time_series.hpp"
#include "undine/schemes/flow.hpp"

namespace undine {

/// What gauges must know of the case besides their own table.
template <int N>
struct GaugeContext {
  double spacing = 0;   ///< of the particles, m
  double interval = 0;  ///< time between samples where a gauge does not say, s
  Vec<N> gravity{};     ///< m/s^2
  Domain<N> domain = Domain<N>::unbounded();
  std::map<std::string, int> bodies = {};  ///< numbers of the walls that have a name
  std::vector<int> body_of_id =
      {};              ///< body of each particle, by particle id; may be empty for a check of the case alone
  double support = 0;  ///< H at the start, m
  std::vector<std::string> materials = {};              ///< names of the fluids, by number; all different
  std::vector<double> rest_densities = {};              ///< rho_0 of each, kg/m^3
  std::shared_ptr<const ReflectingSurface> walls = {};  ///< surfaces of all walls; may be absent
  Bounds container = {};                                ///< of the walls with the fluid inside, m
};

/// One instrument: it reads the run and changes nothing.
template <int N>
class Gauge {
 public:
  virtual ~Gauge() = default;
  /// What `read` gives, without the time.
  virtual std::vector<SeriesColumn> columns() const = 0;
  /// One value per column, in SI units; NaN where there is nothing to measure.
  virtual std::vector<double> read(const Flow<N>& flow) const = 0;
  /// Whether field acc of the walls must hold the forces from the fluid before `read`.
  virtual bool needs_wall_forces() const { return false; }
};

/// What the types of gauges share.
namespace gauges {

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();
inline const std::vector<std::string> all_axes{"x", "y", "z"};

template <int N>
const std::vector<std::string>& axes() {
  static const std::vector<std::string> words(all_axes.begin(), all_axes.begin() + N);
  return words;
}

/// Index of the axis that a key names.
template <int N>
int read_axis(const Table& table, int fallback) {
  const std::string word = table.choice("axis", axes<N>(), axes<N>()[static_cast<std::size_t>(fallback)]);
  return word[0] - 'x';
}

template <int N>
Vec<N> read_point(const Table& table, std::string_view key, std::optional<Vec<N>> fallback = {}) {
  const std::vector<double> numbers =
      fallback ? table.quantities(key, unit::length, N, std::vector<double>(fallback->c, fallback->c + N))
               : table.quantities(key, unit::length, N);
  Vec<N> point;
  for (int k = 0; k < N; ++k) point[k] = numbers[static_cast<std::size_t>(k)];
  return point;
}

/// The axis along which gravity is largest; the last one without gravity.
template <int N>
int steepest_axis(const Vec<N>& gravity) {
  int steepest = N - 1;
  for (int k = 0; k < N; ++k)
    if (std::abs(gravity[k]) > std::abs(gravity[steepest])) steepest = k;
  return steepest;
}

template <int N>
void require_walls(const Table& table, const GaugeContext<N>& context) {
  if (!context.walls || context.walls->empty())
    table.fail("type", "this gauge needs a wall with a shape", "it measures distances to the walls' surfaces",
               "add a [[wall]] with a shape, or remove the gauge");
}

}  // namespace gauges
}  // namespace undine
