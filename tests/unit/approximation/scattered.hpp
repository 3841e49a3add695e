#pragma once
#include <cmath>
#include <vector>

#include "undine/approximation/approximation.hpp"
#include "undine/approximation/catalogue.hpp"
#include "unit/engine/crowd.hpp"

namespace undine::test {

/// n^N points around the cell centres of the unit cube, each moved by up to a quarter of a spacing.
template <int N>
approximation::Points<N> scattered(int n, Random& random) {
  approximation::Points<N> points;
  const int count = N == 1 ? n : N == 2 ? n * n : n * n * n;
  for (int i = 0; i < count; ++i) {
    Vec<N> x = random.vector<N>(0.25 / n);
    for (int k = 0, rest = i; k < N; ++k, rest /= n) x[k] += (rest % n + 0.5) / n;
    points.x.push_back(x);
    points.volume.push_back(std::pow(n, -N));
  }
  return points;
}

/// Calls f(name, order) for every method with each of its orders.
template <class F>
void for_each_method(F&& f) {
  approximation::Methods::for_each([&]<class M>(M) {
    for (int order = M::lowest_order; order <= M::highest_order; ++order) f(std::string(M::info.name), order);
  });
}

}  // namespace undine::test
