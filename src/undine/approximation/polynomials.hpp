#pragma once
#include <Eigen/Core>

#include "undine/approximation/method.hpp"

namespace undine::approximation {

/// Where s_a s_b stands in the basis.
template <int N>
constexpr int quadratic(int a, int b) {
  return a <= b ? 1 + N + a * N - a * (a - 1) / 2 + b - a : quadratic<N>(b, a);
}

/// As many numbers as a basis has at most; no memory is taken from the heap.
using Terms = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 10, 1>;
using Moments = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 10, 10>;

/// The Taylor basis 1, s_a, s_a^2/2, s_a s_b up to a degree: the coefficient of each is that derivative at s = 0.
template <int N>
Terms taylor_basis(const Vec<N>& s, int degree) {
  Terms p(terms(N, degree));
  p[0] = 1;
  if (degree > 0)
    for (int a = 0; a < N; ++a) p[1 + a] = s[a];
  if (degree > 1)
    for (int a = 0; a < N; ++a)
      for (int b = a; b < N; ++b) p[quadratic<N>(a, b)] = a == b ? s[a] * s[a] / 2 : s[a] * s[b];
  return p;
}

/// The unit vector of term k, or zero where the basis has not that term.
inline Terms unit_term(int count, int k) {
  Terms e = Terms::Zero(count);
  if (k < count) e[k] = 1;
  return e;
}

}  // namespace undine::approximation
