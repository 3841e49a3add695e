#pragma once
#include <numbers>

#include "undine/core/catalogue.hpp"
#include "undine/core/value.hpp"
#include "undine/core/vec.hpp"

namespace undine::kernel_parts {

inline constexpr double pi = std::numbers::pi;
inline constexpr double sqrt_pi = 1 / std::numbers::inv_sqrtpi;
inline constexpr double erf_3 = 0.99997790950300141456;
inline constexpr double exp_minus_9 = 1.2340980408667954950e-4;

/// The value for N = 1, 2 or 3 dimensions.
template <int N>
constexpr double by_dimension(double one, double two, double three) {
  static_assert(1 <= N && N <= 3, "kernels are defined in 1, 2 and 3 dimensions");
  return N == 1 ? one : N == 2 ? two : three;
}

/// edge - R where that is positive, else 0: the factor by which polynomial pieces vanish from `edge` on.
template <class V>
constexpr V below(double edge, const V& R) {
  return max(V(0), V(edge) - R);
}

/// R, but not so small that a kernel with a kink at R = 0 could not be divided by it.
template <class V>
constexpr V away_from_zero(const V& R) {
  return max(V(1e-9), R);
}

}  // namespace undine::kernel_parts
