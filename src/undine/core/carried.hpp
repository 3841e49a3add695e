#pragma once
#include <concepts>
#include <type_traits>

#include "undine/core/vec.hpp"

namespace undine {

// Numbers that know more than their value, so that a term can be written like its equation and still cost what a loop
// by hand would: what is the same for all pairs of a particle is computed once, where its record is packed.

/// A number and its reciprocal: dividing by it is a multiplication.
template <class V>
struct Known {
  V number;
  V reciprocal;

  [[gnu::always_inline]] constexpr V value() const { return number; }
  [[gnu::always_inline]] constexpr V inverse() const { return reciprocal; }
  [[gnu::always_inline]] constexpr operator V() const { return number; }
};

/// The same for a number kept as its difference from a reference that all particles share, so that differences of two
/// such numbers keep their digits: a density in float is good to 6e-5 kg/m^3 of 1000, its deviation from 1000 to 1e-7
/// of itself.
template <class V>
struct Shifted {
  V difference;
  V reference;
  V reciprocal;

  [[gnu::always_inline]] constexpr V value() const { return reference + difference; }
  [[gnu::always_inline]] constexpr V inverse() const { return reciprocal; }
  [[gnu::always_inline]] constexpr operator V() const { return value(); }
};

template <class T>
inline constexpr bool is_shifted = false;
template <class V>
inline constexpr bool is_shifted<Shifted<V>> = true;

template <class T>
inline constexpr bool is_carried = is_shifted<T>;
template <class V>
inline constexpr bool is_carried<Known<V>> = true;

namespace detail {

template <class T>
[[gnu::always_inline]] constexpr decltype(auto) plain(const T& a) {
  if constexpr (is_carried<T>) {
    return a.value();
  } else {
    return (a);
  }
}

template <class A, class B>
concept OneCarried = (is_carried<A> || is_carried<B>)&&!is_vec<A> && !is_vec<B>;
template <class A, class B>
concept BothCarried = is_carried<A> && is_carried<B>;

}  // namespace detail

/// The reference cancels.
template <class A, class B>
[[gnu::always_inline]] constexpr auto operator-(const Shifted<A>& a, const Shifted<B>& b) {
  return a.difference - b.difference;
}
template <class A, class B>
requires detail::OneCarried<A, B>
[[gnu::always_inline]] constexpr auto operator-(const A& a, const B& b) { return detail::plain(a) - detail::plain(b); }
template <class A, class B>
requires detail::OneCarried<A, B>
[[gnu::always_inline]] constexpr auto operator+(const A& a, const B& b) { return detail::plain(a) + detail::plain(b); }

/// The reciprocal of a product of two is the product of theirs.
template <class A, class B>
requires detail::OneCarried<A, B>
[[gnu::always_inline]] constexpr auto operator*(const A& a, const B& b) {
  if constexpr (detail::BothCarried<A, B>) {
    using V = decltype(a.value() * b.value());
    return Known<V>{a.value() * b.value(), a.inverse() * b.inverse()};
  } else {
    return detail::plain(a) * detail::plain(b);
  }
}
template <class A, class B>
requires detail::OneCarried<A, B>
[[gnu::always_inline]] constexpr auto operator/(const A& a, const B& b) {
  if constexpr (is_carried<B>) {
    return detail::plain(a) * b.inverse();
  } else {
    return detail::plain(a) / b;
  }
}
template <class A>
requires is_carried<A>
[[gnu::always_inline]] constexpr auto operator-(const A& a) { return -a.value(); }

}  // namespace undine
