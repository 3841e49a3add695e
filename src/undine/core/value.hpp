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
inline T sqrt(T a) {
  return std::sqrt(a);
}
template <std::floating_point T>
inline T exp(T a) {
  return std::exp(a);
}
template <std::floating_point T>
inline T pow(T a, T b) {
  return std::pow(a, b);
}
template <std::floating_point T>
inline T abs(T a) {
  return std::abs(a);
}

}  // namespace undine
