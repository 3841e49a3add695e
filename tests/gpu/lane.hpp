#pragma once
#include <type_traits>

#include "undine/core/value.hpp"

namespace undine::gpu {

/// What one GPU thread computes with: a number that stays a T. A plain float would become a double in `0.5 * a.rho`,
/// as constants and parameters of terms are doubles; packs convert them, and so does this.
template <class T>
struct Lane {
  T value = 0;

  Lane() = default;
  template <class S>
  requires std::is_arithmetic_v<S>
  constexpr Lane(S s) : value(static_cast<T>(s)) {}

  friend constexpr Lane operator+(Lane a, Lane b) { return a.value + b.value; }
  friend constexpr Lane operator-(Lane a, Lane b) { return a.value - b.value; }
  friend constexpr Lane operator*(Lane a, Lane b) { return a.value * b.value; }
  friend constexpr Lane operator/(Lane a, Lane b) { return a.value / b.value; }
  friend constexpr Lane operator-(Lane a) { return -a.value; }
  constexpr Lane& operator+=(Lane o) {
    value += o.value;
    return *this;
  }
  friend constexpr bool operator<(Lane a, Lane b) { return a.value < b.value; }
  friend constexpr bool operator>(Lane a, Lane b) { return a.value > b.value; }

  friend constexpr Lane select(bool mask, Lane yes, Lane no) { return mask ? yes : no; }
  friend constexpr Lane max(Lane a, Lane b) { return undine::max(a.value, b.value); }
  friend constexpr Lane min(Lane a, Lane b) { return undine::min(a.value, b.value); }
  friend constexpr Lane sqrt(Lane a) { return undine::sqrt(a.value); }
  friend constexpr Lane exp(Lane a) { return undine::exp(a.value); }
  friend constexpr Lane abs(Lane a) { return undine::abs(a.value); }
  friend constexpr Lane negative_part(Lane a) { return undine::negative_part(a.value); }
  friend constexpr Lane positive_part(Lane a) { return undine::positive_part(a.value); }
};

}  // namespace undine::gpu
