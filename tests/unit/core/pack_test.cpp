#include "undine/core/pack.hpp"

#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "undine/core/vec.hpp"

namespace undine {
namespace {

/// One number per lane, of moderate size and either sign.
template <class T>
std::vector<T> numbers() {
  std::vector<T> values;
  for (int k = 0; k < Pack<T>::lanes; ++k)
    values.push_back(static_cast<T>(*rc::gen::inRange(-1000000, 1000000)) * static_cast<T>(1e-4));
  return values;
}

template <class T>
Pack<T> packed(const std::vector<T>& values) {
  return Pack<T>::generate([&](int k) { return values[k]; });
}

/// Asserts that lane k of the pack is expected(k), bit by bit unless a tolerance (relative) is given. Both pass through
/// memory, or the compiler might join the expected product with the difference into one operation of higher precision.
template <class T, class F>
void expect_lanes(const Pack<T>& pack, F expected, T tolerance = 0) {
  for (int k = 0; k < Pack<T>::lanes; ++k) {
    const volatile T got = pack[k], wanted = expected(k);
    RC_ASSERT(std::abs(got - wanted) <= tolerance * std::abs(wanted));
  }
}

template <class T>
void equals_scalars() {
  const auto a = numbers<T>(), b = numbers<T>();
  const auto A = packed(a), B = packed(b);
  expect_lanes(A, [&](int k) { return a[k]; });
  expect_lanes(Pack<T>(T(3)), [&](int) { return T(3); });
  expect_lanes(A + B, [&](int k) { return a[k] + b[k]; });
  expect_lanes(A - B, [&](int k) { return a[k] - b[k]; });
  expect_lanes(A * B, [&](int k) { return a[k] * b[k]; });
  expect_lanes(-A, [&](int k) { return -a[k]; });
  expect_lanes(
      A / (B * B + 1), [&](int k) { return a[k] / (b[k] * b[k] + 1); }, T(4) * std::numeric_limits<T>::epsilon());
  expect_lanes(2.0 * A, [&](int k) { return T(2) * a[k]; });
  expect_lanes(max(A, B), [&](int k) { return max(a[k], b[k]); });
  expect_lanes(min(A, B), [&](int k) { return min(a[k], b[k]); });
  expect_lanes(abs(A), [&](int k) { return abs(a[k]); });
  expect_lanes(sqrt(abs(A)), [&](int k) { return sqrt(abs(a[k])); });
  expect_lanes(positive_part(A), [&](int k) { return positive_part(a[k]); });
  expect_lanes(negative_part(A), [&](int k) { return negative_part(a[k]); });
  expect_lanes(select(A < B, A, B), [&](int k) { return select(a[k] < b[k], a[k], b[k]); });
  expect_lanes(select(A > B, A, B), [&](int k) { return select(a[k] > b[k], a[k], b[k]); });
  expect_lanes(select(A <= A, A, B), [&](int k) { return a[k]; });
  expect_lanes(select(A >= B, A, B), [&](int k) { return select(a[k] >= b[k], a[k], b[k]); });
  const T near = T(8) * std::numeric_limits<T>::epsilon();
  expect_lanes(
      exp(A * 0.1), [&](int k) { return exp(a[k] * T(0.1)); }, near);
  auto sum = A;
  sum += B;
  expect_lanes(sum, [&](int k) { return a[k] + b[k]; });
}

template <class T>
void joins_lanes_in_order() {
  const auto a = numbers<T>();
  auto halved = a;  // the upper half is added to the lower half until one is left
  T largest = a[0];
  for (int half = Pack<T>::lanes / 2; half > 0; half /= 2)
    for (int k = 0; k < half; ++k) halved[k] += halved[k + half];
  for (int k = 1; k < Pack<T>::lanes; ++k) largest = max(largest, a[k]);
  RC_ASSERT(lane_sum(packed(a)) == halved[0]);
  RC_ASSERT(lane_max(packed(a)) == largest);
  RC_ASSERT(lane_sum(a[0]) == a[0]);
  RC_ASSERT(lane_max(a[0]) == a[0]);
}

RC_GTEST_PROP(Pack, FloatEqualsScalarsLaneByLane, ()) { equals_scalars<float>(); }
RC_GTEST_PROP(Pack, DoubleEqualsScalarsLaneByLane, ()) { equals_scalars<double>(); }
RC_GTEST_PROP(Pack, FloatJoinsLanesInOrder, ()) { joins_lanes_in_order<float>(); }
RC_GTEST_PROP(Pack, DoubleJoinsLanesInOrder, ()) { joins_lanes_in_order<double>(); }

TEST(Pack, MakesVectorsOfPacks) {
  const Vec<2, Pack<double>> a{{Pack<double>(3), Pack<double>(4)}};
  const auto length = sqrt(norm_sq(a));
  for (int k = 0; k < Pack<double>::lanes; ++k) EXPECT_EQ(length[k], 5);
  static_assert(std::is_same_v<scalar_of<Pack<float>>, float> && std::is_same_v<scalar_of<double>, double>);
  static_assert(lanes_of<Pack<float>> == Pack<float>::lanes && lanes_of<double> == 1);
}

}  // namespace
}  // namespace undine
