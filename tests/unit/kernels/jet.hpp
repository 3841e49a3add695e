#pragma once
#include <array>
#include <cmath>
#include <type_traits>

namespace undine::test {

/// A truncated Taylor series in one variable: a value type for kernels, by which all derivatives up to `order` come
/// exactly. c[k] is the k-th derivative over k!.
template <int order>
struct Jet {
  std::array<double, order + 1> c{};

  constexpr Jet() = default;
  template <class S>
  requires std::is_arithmetic_v<S>
  constexpr explicit Jet(S s) { c[0] = static_cast<double>(s); }
  /// The variable itself, at x.
  static constexpr Jet variable(double x) {
    Jet jet(x);
    jet.c[1] = 1;
    return jet;
  }
  double derivative(int k) const { return c[k] * std::tgamma(k + 1.0); }

  friend constexpr Jet operator+(Jet a, const Jet& b) {
    for (int k = 0; k <= order; ++k) a.c[k] += b.c[k];
    return a;
  }
  friend constexpr Jet operator-(Jet a, const Jet& b) {
    for (int k = 0; k <= order; ++k) a.c[k] -= b.c[k];
    return a;
  }
  friend constexpr Jet operator*(const Jet& a, const Jet& b) {
    Jet p;
    for (int i = 0; i <= order; ++i)
      for (int j = 0; i + j <= order; ++j) p.c[i + j] += a.c[i] * b.c[j];
    return p;
  }
  friend constexpr Jet operator/(const Jet& a, const Jet& b) {
    Jet q;
    for (int k = 0; k <= order; ++k) {
      q.c[k] = a.c[k];
      for (int j = 0; j < k; ++j) q.c[k] -= q.c[j] * b.c[k - j];
      q.c[k] /= b.c[0];
    }
    return q;
  }
  friend constexpr bool operator<(const Jet& a, const Jet& b) { return a.c[0] < b.c[0]; }
  friend constexpr Jet select(bool mask, const Jet& yes, const Jet& no) { return mask ? yes : no; }
  friend constexpr Jet max(const Jet& a, const Jet& b) { return a.c[0] > b.c[0] ? a : b; }
  friend Jet exp(const Jet& a) {
    Jet e(std::exp(a.c[0]));
    for (int k = 1; k <= order; ++k) {
      for (int j = 1; j <= k; ++j) e.c[k] += j * a.c[j] * e.c[k - j];
      e.c[k] /= k;
    }
    return e;
  }
};

}  // namespace undine::test
