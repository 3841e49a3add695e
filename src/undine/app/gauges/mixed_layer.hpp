#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "undine/app/gauges/heights.hpp"

namespace undine::gauges {

/// The layer in which two fluids that should lie one above the other are mixed.
/// width: 6 times the integral over height of f (1 - f), f the upper fluid's share of the volume at that height: zero
/// where they are apart, the thickness of the layer where f grows in a straight line from 0 to 1. It is a mean over the
/// whole base, so an interface that stands askew counts as a layer as well.
/// overlap: from the height that 5 % of the upper fluid are below to the one that 5 % of the lower are above; negative
/// where they are apart.
template <int N>
class MixedLayer : public Gauge<N> {
 public:
  static constexpr Info info{"mixed_layer", "Thickness of the layer in which two fluids are mixed",
                             "width = 6 int f (1 - f) dz, f = V_upper / (V_upper + V_lower) at z; "
                             "overlap = z_95%(lower) - z_5%(upper)",
                             "Andrews & Spalding (1990), Phys. Fluids A 2:922"};

  MixedLayer(const Table& table, const GaugeContext<N>& context)
      : spacing_(context.spacing), axis_(read_axis<N>(table, steepest_axis(context.gravity))) {
    up_ = context.gravity[axis_] > 0 ? -1 : 1;
    share_ = table.in_range("quantile", unit::one, {0, 0.5}, 0.05);
    const auto& names = context.materials;
    if (names.size() < 2)
      table.fail("type", "a mixed layer needs two fluids", "this case has one", "add a second [[fluid]], or remove it");
    const auto lightest = std::ranges::min_element(context.rest_densities) - context.rest_densities.begin();
    const auto heaviest = std::ranges::max_element(context.rest_densities) - context.rest_densities.begin();
    upper_ = number(table, "upper", names, static_cast<std::size_t>(lightest));
    lower_ = number(table, "lower", names, static_cast<std::size_t>(heaviest));
    if (upper_ == lower_)
      table.fail("lower", "the two fluids of a mixed layer are the same", {}, "name two, 'upper' and 'lower'");
    rho_upper_ = context.rest_densities[static_cast<std::size_t>(upper_)];
    rho_lower_ = context.rest_densities[static_cast<std::size_t>(lower_)];
  }

  std::vector<SeriesColumn> columns() const override { return {{"width", "m"}, {"overlap", "m"}}; }

  std::vector<double> read(const Flow<N>& flow) const override {
    const HeightProfile upper = profile_of(flow, upper_, axis_, up_, spacing_);
    const HeightProfile lower = profile_of(flow, lower_, axis_, up_, spacing_);
    if (upper.z.empty() || lower.z.empty()) return {nan, nan};
    return {width(upper, lower), lower.quantile(1 - share_) - upper.quantile(share_)};
  }

 private:
  static int number(const Table& table, const char* key, const std::vector<std::string>& names, std::size_t fallback) {
    const std::string name = table.choice(key, names, names[fallback]);
    return static_cast<int>(std::ranges::find(names, name) - names.begin());
  }

  /// Slabs of a quarter spacing; each particle is spread over one spacing. Volumes are m/rho_0.
  double width(const HeightProfile& upper, const HeightProfile& lower) const {
    const double low = std::min(std::ranges::min(upper.z), std::ranges::min(lower.z)) - spacing_;
    const double high = std::max(std::ranges::max(upper.z), std::ranges::max(lower.z)) + spacing_;
    const double slab = spacing_ / 4;
    const auto slabs = static_cast<std::size_t>(std::ceil((high - low) / slab));
    const auto volumes = [&](const HeightProfile& profile, double rho_0) {
      std::vector<double> sums(slabs);
      for (std::size_t k = 0; k < profile.z.size(); ++k) {
        const double first = (profile.z[k] - spacing_ / 2 - low) / slab, last = first + spacing_ / slab;
        for (auto s = static_cast<std::size_t>(first); s < slabs && static_cast<double>(s) < last; ++s) {
          const auto edge = static_cast<double>(s);
          sums[s] += profile.m[k] / rho_0 * (std::min(last, edge + 1) - std::max(first, edge)) * slab / spacing_;
        }
      }
      return sums;
    };
    const auto a = volumes(upper, rho_upper_), b = volumes(lower, rho_lower_);
    double integral = 0;
    for (std::size_t s = 0; s < slabs; ++s)
      if (a[s] + b[s] > 0) integral += a[s] * b[s] / ((a[s] + b[s]) * (a[s] + b[s])) * slab;
    return 6 * integral;
  }

  double spacing_;
  int axis_;
  double up_ = 1, share_ = 0.05;
  int upper_ = 0, lower_ = 0;
  double rho_upper_ = 0, rho_lower_ = 0;  ///< at rest, kg/m^3
};

}  // namespace undine::gauges
