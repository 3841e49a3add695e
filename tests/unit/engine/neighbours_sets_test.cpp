#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "unit/engine/neighbour_lists.hpp"

namespace undine {

using namespace test;

namespace {

template <int N>
Crowd<N> crowd_of(const std::vector<Vec<N>>& fluid, const std::vector<Vec<N>>& wall, const Domain<N>& domain) {
  Crowd<N> crowd{{}, domain, 0.25};
  crowd.store.allocate(Fields<field::x, field::x_list>::set());
  crowd.store.append(Group::fluid, fluid.size(), 0);
  crowd.store.append(Group::wall, wall.size(), 0);
  auto x = crowd.store.template get<field::x>();
  std::ranges::copy(wall, std::ranges::copy(fluid, x.begin()).out);
  return crowd;
}

template <int N>
Domain<N> box(double low, double high, int periodic_axes) {
  Domain<N> domain;
  for (int k = 0; k < N; ++k) {
    domain.low[k] = low;
    domain.high[k] = high;
    domain.periodic[k] = (periodic_axes >> k & 1) != 0;
  }
  return domain;
}

template <int N, class F>
std::vector<Vec<N>> points(int n, F&& f) {
  const int count = n > 1 ? fewer(n, 3) : n;
  std::vector<Vec<N>> all;
  for (int k = 0; k < count; ++k) all.push_back(f(k));
  return all;
}

/// Sets that stumble over cells, in the box [-1, 1]^N, the support being 0.25.
template <int N>
void stumble() {
  Random random(N);
  const auto along = [](double t) {
    Vec<N> x;
    for (int k = 0; k < N; ++k) x[k] = t * (k + 1) / N;
    return x;
  };
  const auto on_faces = [&](int) {
    Vec<N> x;
    for (int k = 0; k < N; ++k) x[k] = 0.25 * 1.15 * 0.25 * std::floor(random.between(-13, 14));
    return x;
  };
  const std::vector<std::vector<Vec<N>>> sets{
      points<N>(150, [&](int) { return random.vector<N>(1); }),                                  // spread out
      points<N>(120, [&](int k) { return along(k % 4 * 0.5 - 0.8) + random.vector<N>(0.05); }),  // clustered
      points<N>(100, [&](int k) { return along(k / 50.0 - 1); }),                                // on a slanted line
      points<N>(60, [&](int k) { return Vec<N>{{k / 30.0 - 1}}; }),                              // along the first axis
      points<N>(200, [&](int) { return along(0.3); }),                                           // on one point
      points<N>(150, on_faces),                                                                  // on cell faces
      points<N>(1, [&](int) { return random.vector<N>(1); }),
      {}};
  const auto wall = points<N>(40, [&](int) { return random.vector<N>(1); });
  for (std::size_t s = 0; s < sets.size(); ++s)
    for (int periodic = 0; periodic < 1 << N; ++periodic) {
      SCOPED_TRACE(testing::Message() << N << "-D, set " << s << ", periodic axes " << periodic);
      expect_all_pairs(crowd_of<N>(sets[s], s % 2 ? wall : std::vector<Vec<N>>{}, box<N>(-1, 1, periodic)));
      if (testing::Test::HasFatalFailure()) return;
    }
}

/// Periods from less than one list radius (0.2875) to ten, where neighbours could be met twice, or by the wrong side.
template <int N>
void short_periods() {
  Random random(7);
  for (const double period : {0.1, 0.3, 0.5, 0.58, 0.6, 0.8, 0.9, 1.2, 2.9})
    for (int periodic = 1; periodic < 1 << N; ++periodic) {
      SCOPED_TRACE(testing::Message() << N << "-D, period " << period << ", periodic axes " << periodic);
      const auto fluid = points<N>(90, [&](int) { return random.vector<N>(0.5 * period); });
      const auto wall = points<N>(30, [&](int) { return random.vector<N>(0.5 * period); });
      expect_all_pairs(crowd_of<N>(fluid, wall, box<N>(-0.5 * period, 0.5 * period, periodic)));
      if (testing::Test::HasFatalFailure()) return;
    }
}

/// Sparse and far particles: wide cells, and codes that do not fit 16 bits.
template <int N>
void far_apart() {
  Random random(9);
  for (const double far : {3.0, 30.0, 1e3, 1e6, 1e9, 1e12})
    for (int axis = 0; axis < (under_sanitizer ? 1 : N); ++axis) {
      SCOPED_TRACE(testing::Message() << N << "-D, outliers " << far << " away along axis " << axis);
      const auto spray = [&](int k) {
        Vec<N> x = random.vector<N>(1);
        if (k % 5 == 0) x[axis] *= far;
        if (k % 5 == 1) x[axis] += far;
        if (k % 15 == 2)
          for (int j = 0; j < N; ++j) x[j] -= far;
        return x;
      };
      const auto fluid = points<N>(fewer(120, 4), spray), wall = points<N>(fewer(30, 3), spray);
      expect_all_pairs(crowd_of<N>(fluid, wall, Domain<N>::unbounded()), 3e-15 * far);
      // A long period along the first axis with few particles.
      auto domain = box<N>(-2 * far, 2 * far, 1);
      expect_all_pairs(crowd_of<N>(fluid, wall, domain), 3e-15 * far);
      if (testing::Test::HasFatalFailure()) return;
    }
}

}  // namespace

TEST(Neighbours, DegenerateSetsHaveTheSameListsByEveryWay) {
  stumble<1>();
  stumble<2>();
  stumble<3>();
}

TEST(Neighbours, ShortPeriodsMeetNoNeighbourTwice) {
  short_periods<1>();
  short_periods<2>();
  short_periods<3>();
}

TEST(Neighbours, FarParticlesAreNoNeighbours) {
  far_apart<1>();
  far_apart<2>();
  far_apart<3>();
}

// Criterion: as above, for any number, density, box and place of the particles.
RC_GTEST_PROP(Neighbours, ListsAreTheSameByEveryWay, ()) {
  constexpr int N = 3;
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const int n = *rc::gen::inRange(0, 200);
  const double size = random.between(0.1, 3), origin = random.between(-1, 1) * std::pow(10, random.between(-2, 3));
  const auto inside = [&](int) {
    Vec<N> x = random.vector<N>(size);
    for (int k = 0; k < N; ++k) x[k] += origin;
    return x;
  };
  const auto domain = box<N>(origin - size, origin + size, static_cast<int>(random.bits() % (1 << N)));
  expect_all_pairs(crowd_of<N>(points<N>(n, inside), points<N>(n / 4, inside), domain), 1e-12);
  RC_ASSERT(!testing::Test::HasFailure());
}

}  // namespace undine
