#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#include "undine/core/domain.hpp"
#include "undine/core/pack.hpp"

namespace undine::detail {

/// Positions as the pair loop sees them. `double`: as they are. `float`: 32-bit fixed point, so that differences of
/// near particles are exact to 2^-24 of the list radius however far from the origin they are; along a periodic axis the
/// period is 2^32 units, so that the difference of two positions wraps to the nearest image by itself.
template <int N, class Real>
class PositionCode;

template <int N>
class PositionCode<N, double> {
 public:
  PositionCode(const Domain<N>& domain, double) : domain_(domain) {}
  Vec<N, double> encode(const Vec<N>& x) const { return x; }

  template <class V>
  Vec<N, V> difference(const Vec<N, double>& a, const Vec<N, V>& b) const {
    Vec<N, V> d = a - b;
    for (int k = 0; k < N; ++k)
      if (domain_.periodic[k]) d[k] = wrap(d[k], domain_.length(k));
    return d;
  }

 private:
  /// Both particles lie within one period, give or take a step: one shift suffices.
  template <class V>
  static V wrap(const V& d, double period) {
    const V shifted = select(d > V(0.5 * period), d - V(period), d);
    return select(shifted < V(-0.5 * period), shifted + V(period), shifted);
  }
  Domain<N> domain_;
};

template <int N>
class PositionCode<N, float> {
 public:
  PositionCode(const Domain<N>& domain, double list_radius) {
    for (int k = 0; k < N; ++k) {
      unit_[k] = domain.periodic[k] ? domain.length(k) * 0x1p-32 : list_radius * 0x1p-24;
      origin_[k] = domain.periodic[k] ? domain.low[k] : 0.0;
      width_[k] = static_cast<float>(unit_[k]);
    }
  }
  Vec<N, float> encode(const Vec<N>& x) const {
    Vec<N, float> code;
    for (int k = 0; k < N; ++k) {
      const double units = std::nearbyint((x[k] - origin_[k]) / unit_[k]);
      // Beyond 2^63 units nothing is near anything; keep the conversion defined.
      const double safe = units > -0x1p62 && units < 0x1p62 ? units : 0.0;
      code[k] = std::bit_cast<float>(static_cast<std::uint32_t>(static_cast<std::int64_t>(safe)));
    }
    return code;
  }

  template <class V>
  Vec<N, V> difference(const Vec<N, float>& a, const Vec<N, V>& b) const {
    Vec<N, V> d;
    for (int k = 0; k < N; ++k) d[k] = fixed_difference(a[k], b[k]) * V(width_[k]);
    return d;
  }

 private:
  static float fixed_difference(float a, float b) {
    return static_cast<float>(
        static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(a) - std::bit_cast<std::uint32_t>(b)));
  }
  static Pack<float> fixed_difference(float a, const Pack<float>& b) {
    namespace stdx = std::experimental;
    using Unsigned = stdx::rebind_simd_t<std::uint32_t, Pack<float>::Native>;
    using Signed = stdx::rebind_simd_t<std::int32_t, Pack<float>::Native>;
    const auto difference = Unsigned(std::bit_cast<std::uint32_t>(a)) - std::bit_cast<Unsigned>(b.native());
    return Pack<float>(stdx::static_simd_cast<Pack<float>::Native>(std::bit_cast<Signed>(difference)));
  }

  Vec<N> unit_, origin_;
  Vec<N, float> width_;
};

}  // namespace undine::detail
