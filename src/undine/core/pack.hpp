#pragma once
#include <cstdint>
#include <experimental/simd>
#include <type_traits>

#include "undine/core/value.hpp"

namespace undine {

/// As many numbers as fit one vector register, with the same operations as a single number (core/value.hpp).
template <class T>
class Pack {
 public:
  using Native = std::experimental::native_simd<T>;
  using Mask = typename Native::mask_type;
  static constexpr int lanes = static_cast<int>(Native::size());

  Pack() = default;
  template <class S>
  requires std::is_arithmetic_v<S> Pack(S s) : native_(static_cast<T>(s)) {}
  Pack(const Native& native) : native_(native) {}

  /// The pack whose lane k is f(k).
  template <class F>
  static Pack generate(F&& f) {
    return Native([&](auto k) { return static_cast<T>(f(static_cast<int>(k))); });
  }

  const Native& native() const { return native_; }
  T operator[](int lane) const { return native_[static_cast<std::size_t>(lane)]; }

  friend Pack operator+(const Pack& a, const Pack& b) { return a.native_ + b.native_; }
  friend Pack operator-(const Pack& a, const Pack& b) { return a.native_ - b.native_; }
  friend Pack operator*(const Pack& a, const Pack& b) { return a.native_ * b.native_; }
  friend Pack operator/(const Pack& a, const Pack& b) { return a.native_ / b.native_; }
  friend Pack operator-(const Pack& a) { return -a.native_; }
  Pack& operator+=(const Pack& o) {
    native_ += o.native_;
    return *this;
  }
  friend Mask operator<(const Pack& a, const Pack& b) { return a.native_ < b.native_; }
  friend Mask operator>(const Pack& a, const Pack& b) { return a.native_ > b.native_; }
  friend Mask operator<=(const Pack& a, const Pack& b) { return a.native_ <= b.native_; }
  friend Mask operator>=(const Pack& a, const Pack& b) { return a.native_ >= b.native_; }

  [[gnu::always_inline]] friend Pack select(const Mask& mask, const Pack& yes, const Pack& no) {
    Native result = no.native_;
    where(mask, result) = yes.native_;
    return result;
  }
  friend Pack max(const Pack& a, const Pack& b) { return std::experimental::max(a.native_, b.native_); }
  friend Pack min(const Pack& a, const Pack& b) { return std::experimental::min(a.native_, b.native_); }
  friend Pack sqrt(const Pack& a) { return std::experimental::sqrt(a.native_); }
  friend Pack exp(const Pack& a) { return std::experimental::exp(a.native_); }
  friend Pack pow(const Pack& a, const Pack& b) { return std::experimental::pow(a.native_, b.native_); }
  friend Pack abs(const Pack& a) { return std::experimental::abs(a.native_); }

  /// Sum and largest of all lanes, always in the same order.
  friend T lane_sum(const Pack& a) {
    T s = a[0];
    for (int k = 1; k < lanes; ++k) s += a[k];
    return s;
  }
  friend T lane_max(const Pack& a) { return hmax(a.native_); }

 private:
  Native native_;
};

template <class T>
struct ScalarOf {
  using type = T;
};
template <class T>
struct ScalarOf<Pack<T>> {
  using type = T;
};
/// The number type inside a value type.
template <class V>
using scalar_of = typename ScalarOf<V>::type;

template <class V>
inline constexpr int lanes_of = 1;
template <class T>
inline constexpr int lanes_of<Pack<T>> = Pack<T>::lanes;

template <std::floating_point T>
constexpr T lane_sum(T a) {
  return a;
}
template <std::floating_point T>
constexpr T lane_max(T a) {
  return a;
}

/// max(a, 0) and min(a, 0), for terms that act on approach or on separation only.
template <class V>
constexpr V positive_part(const V& a) {
  return max(a, V(0));
}
template <class V>
constexpr V negative_part(const V& a) {
  return min(a, V(0));
}

}  // namespace undine
