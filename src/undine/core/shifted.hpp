#pragma once
#include <type_traits>

#include "undine/core/vec.hpp"

namespace undine {

/// A value kept as its difference from a reference that all particles share, so that differences of two such values
/// keep their digits: a density in float is good to 6e-5 kg/m^3 of 1000, its deviation from 1000 to 1e-7 of itself.
template <class V>
struct Shifted {
  V difference;
  V reference;

  [[gnu::always_inline]] constexpr V value() const { return reference + difference; }
};

template <class T>
inline constexpr bool is_shifted = false;
template <class V>
inline constexpr bool is_shifted<Shifted<V>> = true;

namespace detail {

template <class T>
[[gnu::always_inline]] constexpr const T& plain(const T& a) {
  return a;
}
template <class V>
[[gnu::always_inline]] constexpr V plain(const Shifted<V>& a) {
  return a.value();
}

template <class A, class B>
concept OneShifted = (is_shifted<A> || is_shifted<B>)&&!is_vec<A> && !is_vec<B>;

}  // namespace detail

/// The reference cancels.
template <class A, class B>
[[gnu::always_inline]] constexpr auto operator-(const Shifted<A>& a, const Shifted<B>& b) {
  return a.difference - b.difference;
}

// Everything else sees the value.
template <class A, class B>
requires detail::OneShifted<A, B>
[[gnu::always_inline]] constexpr auto operator-(const A& a, const B& b) { return detail::plain(a) - detail::plain(b); }
template <class A, class B>
requires detail::OneShifted<A, B>
[[gnu::always_inline]] constexpr auto operator+(const A& a, const B& b) { return detail::plain(a) + detail::plain(b); }
template <class A, class B>
requires detail::OneShifted<A, B>
[[gnu::always_inline]] constexpr auto operator*(const A& a, const B& b) { return detail::plain(a) * detail::plain(b); }
template <class A, class B>
requires detail::OneShifted<A, B>
[[gnu::always_inline]] constexpr auto operator/(const A& a, const B& b) { return detail::plain(a) / detail::plain(b); }
template <class V>
[[gnu::always_inline]] constexpr V operator-(const Shifted<V>& a) {
  return -a.value();
}

}  // namespace undine
