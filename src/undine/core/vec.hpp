#pragma once
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace undine {

/// A vector of N components; T is a number or a pack of numbers.
template <int N, class T = double>
struct Vec {
  T c[N]{};

  constexpr T& operator[](int k) { return c[k]; }
  constexpr const T& operator[](int k) const { return c[k]; }

  constexpr Vec& operator+=(const Vec& o) {
    for (int k = 0; k < N; ++k) c[k] = c[k] + o.c[k];
    return *this;
  }
  constexpr Vec& operator-=(const Vec& o) {
    for (int k = 0; k < N; ++k) c[k] = c[k] - o.c[k];
    return *this;
  }
  constexpr bool operator==(const Vec& o) const = default;
};

template <class T>
inline constexpr bool is_vec = false;
template <int N, class T>
inline constexpr bool is_vec<Vec<N, T>> = true;

/// What may multiply a vector: any number or pack, but not another vector.
template <class T>
concept Scalar = !is_vec<std::remove_cvref_t<T>>;

template <int N, class A, class B>
constexpr auto operator+(const Vec<N, A>& a, const Vec<N, B>& b) {
  Vec<N, decltype(a[0] + b[0])> s;
  for (int k = 0; k < N; ++k) s[k] = a[k] + b[k];
  return s;
}
template <int N, class A, class B>
constexpr auto operator-(const Vec<N, A>& a, const Vec<N, B>& b) {
  Vec<N, decltype(a[0] - b[0])> d;
  for (int k = 0; k < N; ++k) d[k] = a[k] - b[k];
  return d;
}
template <int N, class A>
constexpr auto operator-(const Vec<N, A>& a) {
  Vec<N, A> d;
  for (int k = 0; k < N; ++k) d[k] = -a[k];
  return d;
}
template <int N, class A, Scalar B>
constexpr auto operator*(const Vec<N, A>& a, const B& s) {
  Vec<N, decltype(a[0] * s)> p;
  for (int k = 0; k < N; ++k) p[k] = a[k] * s;
  return p;
}
template <int N, Scalar A, class B>
constexpr auto operator*(const A& s, const Vec<N, B>& a) {
  return a * s;
}
template <int N, class A, Scalar B>
constexpr auto operator/(const Vec<N, A>& a, const B& s) {
  Vec<N, decltype(a[0] / s)> p;
  for (int k = 0; k < N; ++k) p[k] = a[k] / s;
  return p;
}

template <int N, class A, class B>
constexpr auto dot(const Vec<N, A>& a, const Vec<N, B>& b) {
  auto s = a[0] * b[0];
  for (int k = 1; k < N; ++k) s = s + a[k] * b[k];
  return s;
}
template <int N, class A>
constexpr auto norm_sq(const Vec<N, A>& a) {
  return dot(a, a);
}
template <int N>
inline double norm(const Vec<N, double>& a) {
  return std::sqrt(norm_sq(a));
}
template <class A, class B>
constexpr auto cross(const Vec<3, A>& a, const Vec<3, B>& b) {
  using T = decltype(a[0] * b[0]);
  return Vec<3, T>{{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

/// The tensor a (x) b: element [i][j] is a_i b_j.
template <int N, class A, class B>
constexpr auto outer(const Vec<N, A>& a, const Vec<N, B>& b) {
  Vec<N, Vec<N, decltype(a[0] * b[0])>> t;
  for (int k = 0; k < N; ++k) t[k] = a[k] * b;
  return t;
}

/// t . n of a tensor and a vector.
template <int N, class A, class B>
constexpr auto times(const Vec<N, Vec<N, A>>& t, const Vec<N, B>& n) {
  Vec<N, decltype(t[0][0] * n[0])> p;
  for (int k = 0; k < N; ++k) p[k] = dot(t[k], n);
  return p;
}

/// Square, cube and whole powers, so that equations read as they are printed.
template <class T>
constexpr auto sq(const T& a) {
  return a * a;
}
template <class T>
constexpr auto cube(const T& a) {
  return a * a * a;
}

}  // namespace undine
