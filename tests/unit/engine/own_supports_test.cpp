#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "unit/engine/neighbour_lists.hpp"

// Lists of particles whose supports are of their own, over a decade or three.

namespace undine {

using namespace test;

namespace {

constexpr double skin = 0.15;

struct Spread {
  int fluid = 0, wall = 0;
  double size = 1;      ///< of the box, from the origin in all directions
  double widest = 0.4;  ///< H
  double narrowest = 0.02;
  int periodic_axes = 0;  ///< a bit for each
};

/// Particles at random, clustered where they are narrow, with H spread evenly over its logarithm.
template <int N>
Crowd<N> spread_out(const Spread& o, Random& random) {
  Crowd<N> crowd{{}, Domain<N>::unbounded(), 0};
  for (int k = 0; k < N; ++k) {
    crowd.domain.low[k] = -o.size;
    crowd.domain.high[k] = o.size;
    crowd.domain.periodic[k] = (o.periodic_axes >> k & 1) != 0;
  }
  auto& store = crowd.store;
  store.allocate(Fields<field::x, field::h, field::x_list, field::h_list>::set());
  store.append(Group::fluid, static_cast<std::size_t>(o.fluid), 0);
  store.append(Group::wall, static_cast<std::size_t>(o.wall), 0);
  for (std::size_t i = 0; i < store.size(); ++i) {
    const double share = random.between(0, 1);
    const double H =
        i == 0 || random.bits() % 20 ? o.widest * std::pow(o.narrowest / o.widest, share) : 0;  // some have none
    store.template get<field::h>()[i] = H;
    store.template get<field::x>()[i] = random.vector<N>(o.size * (random.bits() % 3 ? 1 - 0.9 * share : 1));
    crowd.support = std::max(crowd.support, H);
  }
  return crowd;
}

template <int N>
Neighbours<N> own_lists_of(Crowd<N>& crowd, typename Neighbours<N>::Options options) {
  options.skin = skin;
  options.own_supports = true;
  Neighbours<N> neighbours(crowd.domain, options);
  neighbours.build(crowd.store, crowd.support);
  return neighbours;
}

/// Whether each target's list is ascending, has every source nearer than factor times the larger H of the two, and none
/// farther than a little more. `rounding` in m.
template <int N>
void expect_reach(const Neighbours<N>& neighbours, const Crowd<N>& crowd, double factor, bool and_no_farther) {
  const auto x = crowd.store.template get<field::x>();
  const auto h = crowd.store.template get<field::h>();
  const double rounding = 6 * neighbours.list_radius() / ListCodes<N>::units_per_radius;
  typename Neighbours<N>::Scratch scratch;
  for (const auto& [target, source] : group_pairs) {
    const IndexRange targets = crowd.store.range(target), sources = crowd.store.range(source);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const auto list = neighbours.of(target, t, source, crowd.store, scratch);
      ASSERT_TRUE(std::ranges::adjacent_find(list, std::greater_equal<>()) == list.end());
      auto next = list.begin();
      const std::size_t a = targets.begin + t;
      for (std::size_t b = sources.begin; b < sources.end; ++b) {
        const double r = norm(crowd.domain.nearest_image(x[a] - x[b])), reach = factor * std::max(h[a], h[b]);
        const bool listed = next != list.end() && *next == b;
        if (listed) ++next;
        ASSERT_TRUE(listed || r >= reach) << "r = " << r << " of " << reach;
        ASSERT_TRUE(!listed || !and_no_farther || r <= reach + rounding);
      }
      ASSERT_TRUE(next == list.end());
    }
  }
}

/// The usual way and four others: over many crowds all of them.
template <int N>
auto some_ways(Random& random) {
  const auto all = all_ways<N>();
  std::vector some{all.front()};
  for (const std::uint32_t k : random.shuffled(all.size()))
    if (k > 0 && some.size() < 5) some.push_back(all[k]);
  return some;
}

/// The same lists by every way and for any number of threads, from any order before.
template <int N>
void expect_the_same_by_every_way(const Crowd<N>& made, Random& random) {
  std::vector<std::int64_t> expected, ids;
  for (const auto& options : some_ways<N>(random))
    for (const int threads : {1, 3}) {
      const bool usual = options.search == "cell_grid" && options.lists == Lists::stored;
      if (threads > 1 && !(usual && options.instructions == InstructionSet::basic)) continue;
      const Threads use(threads);
      auto crowd = made;
      for (const Group group : all_groups) crowd.store.permute(group, random.shuffled(crowd.store.range(group).size()));
      const auto neighbours = own_lists_of(crowd, options);
      const auto lists = all_lists(neighbours, crowd.store);
      if (ids.empty()) {
        expected = lists;
        ids.assign(crowd.store.ids().begin(), crowd.store.ids().end());
        expect_reach(neighbours, crowd, 1 + skin, true);
        if (testing::Test::HasFatalFailure()) return;
      }
      ASSERT_TRUE(std::ranges::equal(crowd.store.ids(), ids));
      ASSERT_EQ(lists, expected) << options.search << ", way " << static_cast<int>(options.lists) << ", instructions "
                                 << static_cast<int>(options.instructions) << ", threads " << threads;
      Neighbours<N> again(crowd.domain, [&] {
        auto same = options;
        same.skin = skin;
        same.own_supports = true;
        return same;
      }());
      auto moved = crowd;
      for (auto& at : moved.store.template get<field::x>()) at += random.vector<N>(0.1);
      for (auto& H : moved.store.template get<field::h>()) H *= random.between(0.5, 2);
      again.rebuild_from_list_positions(moved.store, neighbours.support());
      ASSERT_EQ(all_lists(again, moved.store), expected) << "rebuilt";
    }
}

/// Moves and growths at random, of which the largest use up the skin but for a thousandth.
template <int N>
void move_within_skin(Crowd<N>& crowd, Random& random) {
  auto x = crowd.store.template get<field::x>();
  auto h = crowd.store.template get<field::h>();
  const double growth = random.between(0, 0.999 * skin), move = 0.5 * (0.999 * skin - growth);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Vec<N> way = random.vector<N>(1);
    if (norm(way) > 0) x[i] += way * (move * h[i] / norm(way));
    h[i] *= random.bits() % 2 ? 1 + growth : random.between(0.3, 1);
    crowd.support = std::max(crowd.support, h[i]);
  }
}

template <int N>
void any_crowd() {
  const Threads one(1);
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  Spread spread;
  spread.fluid = 1 + fewer(*rc::gen::inRange(1, 150), 3);
  spread.wall = spread.fluid / 4;
  spread.narrowest = spread.widest * std::pow(10, -random.between(0, 3));
  spread.size = random.between(1, 3) * spread.widest * (1 + skin);
  spread.periodic_axes = static_cast<int>(random.bits() % (1 << N));
  auto crowd = spread_out<N>(spread, random);
  expect_the_same_by_every_way(crowd, random);
  if (testing::Test::HasFatalFailure()) return;
  for (auto& H : crowd.store.template get<field::h>())
    if (H == 0) H = spread.narrowest;  // without any, lists are always stale
  for (const Lists lists : {Lists::stored, Lists::free}) {
    auto moving = crowd;
    const auto neighbours = own_lists_of(moving, {.lists = lists});
    move_within_skin(moving, random);
    ASSERT_FALSE(neighbours.stale(moving.store, moving.support));
    expect_reach(neighbours, moving, 1, false);
    if (testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace

// Criterion: for any number, box, periods and supports over up to three decades, every pair nearer than the larger list
// radius of the two is listed and none farther than a hair more; the same lists, in the same order, by every search,
// way, instruction set and number of threads, from any order before, and again from x_list and h_list; and after moves
// and growths just within the skin every pair within the larger support of now is still there.
RC_GTEST_PROP(OwnSupports, NoPairIsEverMissedIn1D, ()) {
  any_crowd<1>();
  RC_ASSERT(!testing::Test::HasFailure());
}
RC_GTEST_PROP(OwnSupports, NoPairIsEverMissedIn2D, ()) {
  any_crowd<2>();
  RC_ASSERT(!testing::Test::HasFailure());
}
RC_GTEST_PROP(OwnSupports, NoPairIsEverMissedIn3D, ()) {
  any_crowd<3>();
  RC_ASSERT(!testing::Test::HasFailure());
}

// Criterion: where all supports are one number, the lists and the order of particles are those of a crowd that has only
// that number.
TEST(OwnSupports, OfOneSizeGiveTheListsOfOneSupport) {
  for_crowds([]<int N>(const Crowd<N>& made) {
    auto own = made, one = made;
    std::ranges::fill(own.store.template get<field::h>(), made.support);
    const auto expected = lists_of(one);
    const auto lists = own_lists_of(own, {});
    ASSERT_TRUE(std::ranges::equal(own.store.ids(), one.store.ids()));
    EXPECT_EQ(all_lists(lists, own.store), all_lists(expected, one.store));
  });
}

// Criterion: one particle that moves by half the skin of its own H, grows by the skin, or is no number, makes lists
// stale; the same move or growth of one ten times as wide does not.
TEST(OwnSupports, StalenessGoesByTheParticlesOwnSupport) {
  Random random(3);
  auto crowd = spread_out<2>({.fluid = 50}, random);
  auto h = crowd.store.get<field::h>();
  for (std::size_t i = 0; i < h.size(); ++i) h[i] = i == 7 ? 0.04 : 0.4;
  crowd.support = 0.4;
  auto neighbours = own_lists_of(crowd, {});
  h = crowd.store.get<field::h>();
  auto x = crowd.store.get<field::x>();
  const auto narrow = static_cast<std::size_t>(std::ranges::find(crowd.store.ids(), 7) - crowd.store.ids().begin());
  const std::size_t wide = narrow == 0 ? 1 : 0;
  const auto stale_after = [&](auto&& change, auto&& back) {
    change();
    const bool stale = neighbours.stale(crowd.store, crowd.support);
    back();
    return stale;
  };
  const auto moved = [&](std::size_t i, double by) {
    return stale_after([&] { x[i][0] += by; }, [&] { x[i][0] -= by; });
  };
  const auto grown = [&](std::size_t i, double by) { return stale_after([&] { h[i] += by; }, [&] { h[i] -= by; }); };
  EXPECT_TRUE(moved(narrow, 0.501 * skin * 0.04));
  EXPECT_FALSE(moved(narrow, 0.499 * skin * 0.04));
  EXPECT_FALSE(moved(wide, 0.501 * skin * 0.04));
  EXPECT_TRUE(grown(narrow, 1.001 * skin * 0.04));
  EXPECT_FALSE(grown(narrow, 0.999 * skin * 0.04));
  EXPECT_FALSE(grown(wide, 1.001 * skin * 0.04));
  const double H = h[wide];
  EXPECT_TRUE(stale_after([&] { h[wide] = std::nan(""); }, [&] { h[wide] = H; }));
  EXPECT_FALSE(neighbours.stale(crowd.store, crowd.support));
}

// Criterion: where one particle of a lattice sees everybody, lists grow by the pairs with that one, but for 1 %: whole
// numbers are ten times as coarse.
TEST(OwnSupports, AWideParticleDoesNotMakeAllListsLong) {
  auto crowd = make_crowd<3>({.side = side<3>, .wall_layers = 0});
  std::ranges::fill(crowd.store.get<field::h>(), crowd.support);
  const auto before = own_lists_of(crowd, {}).pair_count(Group::fluid, Group::fluid);
  crowd.store.get<field::h>()[5] = crowd.support *= 10;
  const auto after = own_lists_of(crowd, {}).pair_count(Group::fluid, Group::fluid);
  EXPECT_LE(after, before + before / 100 + 2 * crowd.store.size());
}

}  // namespace undine
