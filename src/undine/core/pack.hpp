#pragma once
#include <bit>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>
#include <utility>

#include "undine/core/exp.hpp"
#include "undine/core/value.hpp"

namespace undine {

/// As many numbers as fit one vector register, with the same operations as a single number (core/value.hpp). They are
/// inlined by force: a single call in a pair loop would cost it all its registers.
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

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) { return a.native_ + b.native_; }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) { return a.native_ - b.native_; }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) { return a.native_ * b.native_; }
  /// By the reciprocal, which the compiler shares between quotients of one divisor.
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) {
    return a.native_ * (Native(T(1)) / b.native_);
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return -a.native_; }
  [[gnu::always_inline]] Pack& operator+=(const Pack& o) {
    native_ += o.native_;
    return *this;
  }
  [[gnu::always_inline]] friend Mask operator<(const Pack& a, const Pack& b) { return a.native_ < b.native_; }
  [[gnu::always_inline]] friend Mask operator>(const Pack& a, const Pack& b) { return a.native_ > b.native_; }
  [[gnu::always_inline]] friend Mask operator<=(const Pack& a, const Pack& b) { return a.native_ <= b.native_; }
  [[gnu::always_inline]] friend Mask operator>=(const Pack& a, const Pack& b) { return a.native_ >= b.native_; }

  [[gnu::always_inline]] friend Pack select(const Mask& mask, const Pack& yes, const Pack& no) {
#if defined(__clang__)
    // Masked assignment of libstdc++ 12 takes all lanes or none where clang compiles it for AVX-512 (_S_blend_avx512).
    if constexpr (sizeof(Mask) < sizeof(T) * lanes) {
      using Int = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
      typedef Int Ints __attribute__((vector_size(sizeof(Native))));
      Ints lane;
      for (int k = 0; k < lanes; ++k) lane[k] = Int(1) << k;
      const auto bits = std::bit_cast<std::conditional_t<lanes <= 8, std::uint8_t, std::uint16_t>>(mask);
      const Ints set = (lane & Int(bits)) != 0;
      return std::bit_cast<Native>(set ? std::bit_cast<Vector<lanes>>(yes.native_)
                                       : std::bit_cast<Vector<lanes>>(no.native_));
    }
#endif
    Native result = no.native_;
    where(mask, result) = yes.native_;
    return result;
  }
  [[gnu::always_inline]] friend Pack max(const Pack& a, const Pack& b) {
    return std::experimental::max(a.native_, b.native_);
  }
  [[gnu::always_inline]] friend Pack min(const Pack& a, const Pack& b) {
    return std::experimental::min(a.native_, b.native_);
  }
  [[gnu::always_inline]] friend Pack sqrt(const Pack& a) { return std::experimental::sqrt(a.native_); }
  friend Pack exp(const Pack& a) { return exponential<T>(a); }
  [[gnu::always_inline]] friend Pack abs(const Pack& a) { return std::experimental::abs(a.native_); }

  /// Sum and largest of all lanes, always in the same order.
  [[gnu::always_inline]] friend T lane_sum(const Pack& a) {
    return fold([](auto x, auto y) { return x + y; }, std::bit_cast<Vector<lanes>>(a.native_));
  }
  [[gnu::always_inline]] friend T lane_max(const Pack& a) {
    return fold([](auto x, auto y) { return x > y ? x : y; }, std::bit_cast<Vector<lanes>>(a.native_));
  }

 private:
  template <int n>
  struct VectorOf {
    typedef T type __attribute__((vector_size(n * sizeof(T))));
  };
  template <int n>
  using Vector = typename VectorOf<n>::type;
  template <int n, class F, int... I>
  [[gnu::always_inline]] static auto halves(F f, const Vector<n>& a, std::integer_sequence<int, I...>) {
    return f(__builtin_shufflevector(a, a, I...), __builtin_shufflevector(a, a, (I + n / 2)...));
  }
  /// Upper half to lower half, until one is left.
  template <int n = lanes, class F>
  [[gnu::always_inline]] static T fold(F f, const Vector<n>& a) {
    if constexpr (n == 2) {
      return f(a[0], a[1]);
    } else {
      return fold<n / 2>(f, halves<n>(f, a, std::make_integer_sequence<int, n / 2>{}));
    }
  }
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
