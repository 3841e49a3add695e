#include "undine/core/vec.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "undine/core/domain.hpp"

namespace undine {
namespace {

/// Vectors of whole numbers, on which sums and products are exact.
template <int N>
Vec<N> whole() {
  Vec<N> a;
  for (int k = 0; k < N; ++k) a[k] = *rc::gen::inRange(-1000, 1000);
  return a;
}

template <class F>
void in_each_dimension(F f) {
  f.template operator()<1>();
  f.template operator()<2>();
  f.template operator()<3>();
}

RC_GTEST_PROP(Vec, IsALinearSpace, ()) {
  in_each_dimension([]<int N>() {
    const auto a = whole<N>(), b = whole<N>();
    const double s = *rc::gen::inRange(-100, 100);
    RC_ASSERT((a + b == b + a));
    RC_ASSERT((a - b == a + (-b)));
    RC_ASSERT((s * (a + b) == a * s + s * b));
    RC_ASSERT(((a * 4.0) / 4.0 == a));
    Vec<N> c = a;
    c += b;
    c -= a;
    RC_ASSERT((c == b));
  });
}

RC_GTEST_PROP(Vec, DotIsBilinearAndOuterIsItsTensor, ()) {
  in_each_dimension([]<int N>() {
    const auto a = whole<N>(), b = whole<N>(), c = whole<N>();
    RC_ASSERT((dot(a, b) == dot(b, a)));
    RC_ASSERT((dot(a, b + c) == dot(a, b) + dot(a, c)));
    RC_ASSERT((norm_sq(a) == dot(a, a)));
    RC_ASSERT((norm(a) == std::sqrt(norm_sq(a))));
    const auto t = outer(a, b);
    double trace = 0;
    for (int i = 0; i < N; ++i) {
      trace += t[i][i];
      for (int j = 0; j < N; ++j) RC_ASSERT((t[i][j] == a[i] * b[j]));
    }
    RC_ASSERT((trace == dot(a, b)));
  });
}

RC_GTEST_PROP(Vec, CrossIsNormalToBothAndOfLagrangesLength, ()) {
  const auto a = whole<3>(), b = whole<3>();
  const auto n = cross(a, b);
  RC_ASSERT((dot(n, a) == 0.0));
  RC_ASSERT((dot(n, b) == 0.0));
  RC_ASSERT((norm_sq(n) == norm_sq(a) * norm_sq(b) - sq(dot(a, b))));
  RC_ASSERT((cross(b, a) == -n));
}

// Criterion: |d| <= L/2 after taking the nearest image, and it differs from d by whole periods, to 1e-9 of the period.
RC_GTEST_PROP(Domain, NearestImageIsShortestAndWrappedIsInside, ()) {
  Domain<3> domain;
  for (int k = 0; k < 3; ++k) {
    domain.low[k] = *rc::gen::inRange(-50, 50);
    domain.high[k] = domain.low[k] + *rc::gen::inRange(1, 40);
    domain.periodic[k] = *rc::gen::arbitrary<bool>();
  }
  const auto d = whole<3>() * 0.37;
  const auto nearest = domain.nearest_image(d);
  const auto inside = domain.wrapped(d);
  for (int k = 0; k < 3; ++k) {
    const double L = domain.length(k);
    if (!domain.periodic[k]) {
      RC_ASSERT((nearest[k] == d[k]));
      RC_ASSERT((inside[k] == d[k]));
      continue;
    }
    RC_ASSERT((std::abs(nearest[k]) <= 0.5 * L * (1 + 1e-9)));
    RC_ASSERT((inside[k] >= domain.low[k]));
    RC_ASSERT((inside[k] <= domain.high[k]));
    for (const double moved : {(nearest[k] - d[k]) / L, (inside[k] - d[k]) / L})
      RC_ASSERT((std::abs(moved - std::nearbyint(moved)) < 1e-9));
  }
}

TEST(Domain, ContainsAsksOnlyAxesThatAreNotPeriodic) {
  auto domain = Domain<2>::unbounded();
  EXPECT_TRUE(domain.contains({{1e300, -1e300}}));
  domain.low = {{0, 0}};
  domain.high = {{1, 1}};
  EXPECT_FALSE(domain.contains({{0.5, 2}}));
  EXPECT_FALSE(domain.contains({{0.5, std::numeric_limits<double>::quiet_NaN()}}));
  domain.periodic[1] = true;
  EXPECT_TRUE(domain.contains({{0.5, 2}}));
  EXPECT_TRUE(domain.any_periodic());
}

}  // namespace
}  // namespace undine
