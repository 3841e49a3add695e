#pragma once
#include "undine/core/vec.hpp"

namespace undine {

/// A point of the line or the plane as one of space, whose further coordinates are 0.
template <int N>
Vec<3> widen(const Vec<N>& p) {
  Vec<3> q{};
  for (int k = 0; k < N; ++k) q[k] = p[k];
  return q;
}

/// The first N coordinates.
template <int N>
Vec<N> narrow(const Vec<3>& p) {
  Vec<N> q;
  for (int k = 0; k < N; ++k) q[k] = p[k];
  return q;
}

}  // namespace undine
