#pragma once
#include <cmath>
#include <concepts>

namespace undine {

// The operations that physics may use on values, for plain numbers. core/pack.hpp has the same set for SIMD packs, so
// that one source of a kernel or a term serves both: `select`, never `if`, on values.

template <std::floating_point T>
constexpr T select(bool mask, T yes, T no) {
  return mask ? yes : no;
}
template <std::floating_point T>
constexpr T max(T a, T b) {
  return a > b ? a : b;
}
template <std::floating_point T>
constexpr T min(T a, T b) {
  return a < b ? a : b;
}
template <std::floating_point T>
constexpr T sqrt(T a) {
  return std::sqrt(a);
}
template <std::floating_point T>
constexpr T exp(T a) {
  return std::exp(a);
}
template <std::floating_point T>
constexpr T pow(T a, T b) {
  return std::pow(a, b);
}
template <std::floating_point T>
constexpr T abs(T a) {
  return std::abs(a);
}

/// max(a, 0) and min(a, 0), for terms that act on approach or on separation only.
template <std::floating_point T>
constexpr T positive_part(const T& a) {
  return max(a, T(0));
}
template <std::floating_point T>
constexpr T negative_part(const T& a) {
  return min(a, T(0));
}

}  // namespace undine
