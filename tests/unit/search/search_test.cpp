#include "undine/search/search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "undine/core/error.hpp"
#include "unit/engine/crowd.hpp"
#include "unit/under_sanitizer.hpp"

namespace undine {
namespace {

using test::Random;

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

/// Criterion of all tests here: every search of the list finds exactly what all_pairs finds, in the same order.
template <int N>
void expect_same(const std::vector<Vec<N>>& points, const std::vector<Vec<N>>& queries, double built_for,
                 const std::vector<double>& radii, const Domain<N>& domain) {
  const auto reference = make_search<N>("all_pairs");
  reference->build(points, built_for, domain);
  std::vector<std::vector<std::uint32_t>> expected;
  for (const double radius : radii)
    for (const auto& x : queries) reference->find(x, radius, expected.emplace_back());
  std::vector<std::uint32_t> found{12345};
  for (const Info& info : search_infos()) {
    const auto search = make_search<N>(std::string(info.name));
    search->build(points, built_for, domain);
    auto next = expected.begin();
    for (const double radius : radii)
      for (const auto& x : queries) {
        search->find(x, radius, found);
        ASSERT_EQ(found, *next++) << info.name << " in " << N << "-D, radius " << radius;
      }
  }
}

/// The points themselves and others, some of them outside of the box.
template <int N>
std::vector<Vec<N>> queries_for(std::vector<Vec<N>> points, Random& random) {
  if (points.size() > 150) points.resize(150);
  for (int k = 0; k < 30; ++k) points.push_back(random.vector<N>(2.0));
  return points;
}

/// Sets of points that searches stumble over, in the box [-1, 1]^N, with a radius of 0.25 in mind.
template <int N>
std::vector<std::vector<Vec<N>>> point_sets(Random& random) {
  std::vector<std::vector<Vec<N>>> sets(1);  // the first is empty
  const auto filled = [&](int n, auto&& point) {
    std::vector<Vec<N>> set;
    for (int k = 0; k < n; ++k) set.push_back(point(k));
    sets.push_back(std::move(set));
  };
  const auto along = [](double t) {
    Vec<N> x;
    for (int k = 0; k < N; ++k) x[k] = t * (k + 1) / N;
    return x;
  };
  filled(1, [&](int) { return random.vector<N>(1); });
  filled(300, [&](int) { return random.vector<N>(1); });                                  // spread out
  filled(200, [&](int k) { return along(k % 4 * 0.5 - 0.8) + random.vector<N>(0.05); });  // clustered
  filled(100, [&](int k) { return along(k / 50.0 - 1); });                                // on a slanted line
  filled(60, [&](int k) { return Vec<N>{{k / 30.0 - 1}}; });                              // along an axis
  filled(40, [&](int) { return along(0.3); });                                            // on one point
  filled(90, [&](int k) { return along(k % 3 * 0.1); });                                  // on three points
  filled(120, [&](int) {                                                                  // in a plane
    auto x = random.vector<N>(1);
    x[N - 1] = 0.1;
    return x;
  });
  filled(80, [&](int k) { return along(std::ldexp(1.0, -12 * (k / 2))); });  // ever closer to the origin
  filled(60, [&](int k) {                                                    // some of them nowhere
    constexpr double nowhere[] = {NAN, INFINITY, -INFINITY};
    auto x = random.vector<N>(1);
    if (k % 5 == 0) x[k % N] = nowhere[k % 3];
    return x;
  });
  filled(50, [&](int k) { return k == 17 ? along(1e6) : random.vector<N>(1); });  // one far outlier
  filled(250, [&](int) {                                                          // on cell faces
    Vec<N> x;
    for (int k = 0; k < N; ++k) x[k] = 0.25 * std::floor(random.between(-4, 5));
    return x;
  });
  filled(250, [&](int) {  // one rounding beside cell faces
    Vec<N> x;
    for (int k = 0; k < N; ++k) {
      x[k] = 0.25 * std::floor(random.between(-4, 5));
      if (random.bits() & 1) x[k] = std::nextafter(x[k], random.bits() & 1 ? 9.0 : -9.0);
    }
    return x;
  });
  return sets;
}

template <int N>
void stumble() {
  Random random(N);
  for (const auto& set : point_sets<N>(random)) {
    const auto queries = queries_for(set, random);
    for (int periodic = 0; periodic < 1 << N; ++periodic) {
      // Outliers of a periodic axis lie many periods away; both searches take them back in.
      expect_same<N>(set, queries, 0.25, {0.25, 0.1, 1e-12}, box<N>(-1, 1, periodic));
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

}  // namespace

TEST(Search, EverySearchFindsWhatAllPairsFinds) {
  stumble<1>();
  stumble<2>();
  stumble<3>();
}

namespace {

// Periods of one, two and three cells, where a neighbour could be met twice by its images.
template <int N>
void small_boxes() {
  Random random(7);
  for (const double period : {0.3, 0.5, 0.6, 0.75, 0.9}) {
    std::vector<Vec<N>> points;
    for (int k = 0; k < 80; ++k) points.push_back(random.vector<N>(0.5 * period));
    for (int periodic = 1; periodic < 1 << N; ++periodic) {
      expect_same<N>(points, points, 0.25, {0.25, 0.2}, box<N>(-0.5 * period, 0.5 * period, periodic));
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

// Radii that are exactly the distance of some pair, and one rounding more; lattice distances, where many pairs tie.
template <int N>
void exact_radii() {
  Random random(11);
  const double spacing = 0.1;
  std::vector<Vec<N>> points;
  for (int k = 0; k < 120; ++k) {
    Vec<N> x;
    for (int d = 0; d < N; ++d) x[d] = spacing * std::floor(random.between(0, 10));
    points.push_back(x);
  }
  for (int periodic = 0; periodic < 1 << N; ++periodic) {
    const auto domain = box<N>(0, 1, periodic);
    for (int k = 1; k < 25; k += test::under_sanitizer ? 6 : 1) {
      const double distance = norm(domain.nearest_image(points[0] - points[k]));
      if (distance == 0) continue;
      const double more = std::nextafter(distance, 9.0), less = std::nextafter(distance, 0.0);
      for (const double built_for : {less, distance, more}) {
        expect_same<N>(points, points, built_for, {built_for}, domain);
        if (::testing::Test::HasFatalFailure()) return;
      }
    }
  }
}

// Cells of awkward widths and pairs that are nearly a radius apart: rounding decides on which side of a face they lie.
template <int N>
void near_the_faces() {
  Random random(13);
  for (int trial = 0; trial < 400; ++trial) {
    const double radius = random.between(0.05, 0.2);
    const double low = random.between(-1, 1);
    const int cells = 1 + static_cast<int>(random.bits() % 9);
    std::vector<Vec<N>> points{Vec<N>{}};
    for (int k = 0; k < N; ++k) points[0][k] = low;
    for (int n = 0; n < 40; ++n) {
      Vec<N> x;
      for (int k = 0; k < N; ++k) {
        x[k] = low + radius * static_cast<double>(random.bits() % 10);
        for (auto steps = random.bits() % 3; steps > 0; --steps)
          x[k] = std::nextafter(x[k], random.bits() & 1 ? 9.0 : -9.0);
        x[k] = std::max(x[k], low);
      }
      points.push_back(x);
    }
    const double built_for = random.bits() & 1 ? radius : std::nextafter(radius, random.bits() & 1 ? 9.0 : 0.0);
    const int periodic = static_cast<int>(random.bits() % (1 << N));
    expect_same<N>(points, points, built_for, {built_for}, box<N>(low, low + cells * radius, periodic));
    if (::testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace

TEST(Search, BoxesOfFewCellsMeetNoNeighbourTwice) {
  small_boxes<1>();
  small_boxes<2>();
  small_boxes<3>();
}

TEST(Search, RadiiThatAreDistancesLeaveThosePairsOut) {
  exact_radii<1>();
  exact_radii<2>();
  exact_radii<3>();
}

TEST(Search, RoundingAtCellFacesLosesNobody) {
  near_the_faces<1>();
  near_the_faces<2>();
  near_the_faces<3>();
}

// Criterion: all_pairs itself finds, ascending, the points whose distance over all 3^N images is less than the radius.
RC_GTEST_PROP(Search, AllPairsIsWhatItSays, ()) {
  const int n = *rc::gen::inRange(0, 40);
  const int periodic = *rc::gen::inRange(0, 4);
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const auto domain = box<2>(-1, 1, periodic);
  std::vector<Vec<2>> points;
  for (int k = 0; k < n; ++k) points.push_back(random.vector<2>(1));
  const auto x = random.vector<2>(1);
  const double radius = random.between(0.01, 0.9);
  std::vector<std::uint32_t> expected, found;
  for (int k = 0; k < n; ++k) {
    bool near = false;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        if ((i != 0 && !domain.periodic[0]) || (j != 0 && !domain.periodic[1])) continue;
        near = near || norm(points[k] + Vec<2>{{2.0 * i, 2.0 * j}} - x) < radius;
      }
    if (near) expected.push_back(k);
  }
  const auto search = make_search<2>("all_pairs");
  search->build(points, radius, domain);
  search->find(x, radius, found);
  RC_ASSERT(found == expected);
}

namespace {

/// A set of one of several kinds, asked for radii up to the one that it is built for.
template <int N>
void any_set(int kind, int n, int periodic, std::uint64_t seed) {
  Random random(seed);
  const double size = random.between(0.05, 1), lattice = random.between(0.02, 0.4);
  std::vector<Vec<N>> points, centres;
  for (int k = 0; k < 5; ++k) centres.push_back(random.vector<N>(1));
  for (int k = 0; k < n; ++k) {
    Vec<N> x = random.vector<N>(size);                                                // spread out
    if (kind == 1) x = centres[k % 5] + random.vector<N>(std::ldexp(1.0, -(k % 9)));  // clustered
    if (kind == 2) x = centres[0] + random.between(-1, 1) * centres[1];               // on a line
    if (kind == 3) x = centres[k % 5];                                                // on a few points
    for (int d = 0; d < N && kind == 4; ++d) x[d] = lattice * std::round(x[d] / lattice);
    points.push_back(x);
  }
  const double radius = random.between(0.01, 0.9);
  expect_same<N>(points, queries_for(points, random), radius, {radius, radius * random.between(0, 1)},
                 box<N>(-1, 1, periodic));
}

}  // namespace

RC_GTEST_PROP(Search, EverySearchFindsTheSameInAnySet, ()) {
  const int kind = *rc::gen::inRange(0, 5), n = *rc::gen::inRange(0, 120), periodic = *rc::gen::inRange(0, 8);
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  any_set<1>(kind, n, periodic & 1, seed);
  any_set<2>(kind, n, periodic & 3, seed);
  any_set<3>(kind, n, periodic, seed);
  RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(Search, AnUnknownNameIsAnInputError) { EXPECT_THROW(make_search<2>("cell_gird"), InputError); }

}  // namespace undine
