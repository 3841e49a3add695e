#include "undine/engine/neighbours.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "unit/engine/neighbour_lists.hpp"

namespace undine {

using namespace test;

TEST(Neighbours, ListsAreAllPairsWithinTheListRadius) {
  for_crowds([]<int N>(const Crowd<N>& made) { expect_all_pairs(made); });
}

// Criterion: after moves of just under half the skin, every pair within the support is still in the lists, and they are
// not stale; with one particle moved further, or a larger support, they are.
TEST(Neighbours, ListsHoldWhileParticlesMoveLessThanHalfTheSkin) {
  for_crowds([]<int N>(Crowd<N> crowd) {
    const auto neighbours = lists_of(crowd);
    const double half_skin = 0.5 * (neighbours.list_radius() - crowd.support);
    Random random(3);
    auto x = crowd.store.template get<field::x>();
    const std::vector<Vec<N>> start(x.begin(), x.end());
    for (auto& at : x) {
      Vec<N> step = random.vector<N>(1);
      if (norm(step) == 0) step[0] = 1;
      at += step * (0.999 * half_skin / norm(step));
    }
    EXPECT_FALSE(neighbours.stale(crowd.store, crowd.support));
    EXPECT_TRUE(neighbours.stale(crowd.store, 1.01 * crowd.support));
    typename Neighbours<N>::Scratch scratch;
    for (const auto& [target, source] : group_pairs) {
      const IndexRange targets = crowd.store.range(target);
      for (std::size_t t = 0; t < targets.size(); ++t) {
        const auto list = neighbours.of(target, t, source, crowd.store, scratch);
        const auto needed = within(crowd, x[targets.begin + t], source, crowd.support);
        ASSERT_TRUE(std::ranges::includes(list, needed));
      }
    }
    std::vector<std::uint32_t> near;
    for (int k = 0; k < 50; ++k) {
      const Vec<N> at = x[random.bits() % x.size()] + random.vector<N>(0.5 * crowd.support);
      for (const Group group : all_groups) {
        neighbours.near_point(at, group, crowd.store, near);
        ASSERT_TRUE(std::ranges::includes(near, within(crowd, at, group, crowd.support)));
      }
    }
    x[0] = start[0];
    x[0][0] += 1.001 * half_skin;
    EXPECT_TRUE(neighbours.stale(crowd.store, crowd.support));
  });
}

// Criterion: a particle that went through a periodic face has not moved far, and is taken back in by the next build.
TEST(Neighbours, PeriodicFacesAreNoDistance) {
  auto crowd = make_crowd<2>({.side = side<2>, .periodic = true});
  auto neighbours = lists_of(crowd);
  auto x = crowd.store.get<field::x>();
  x[0] += Vec<2>{{crowd.domain.length(0), 0}};
  EXPECT_FALSE(neighbours.stale(crowd.store, crowd.support));
  neighbours.build(crowd.store, crowd.support);
  for (const auto& at : crowd.store.get<field::x>())
    for (int k = 0; k < 2; ++k) EXPECT_TRUE(at[k] >= crowd.domain.low[k] && at[k] <= crowd.domain.high[k]);
}

TEST(Neighbours, AreStaleBeforeTheFirstBuild) {
  auto crowd = make_crowd<2>({.side = 5});
  const Neighbours<2> neighbours(crowd.domain, {});
  EXPECT_TRUE(neighbours.stale(crowd.store, crowd.support));
}

// Criterion: the same order of ids from any order before and for any number of threads.
TEST(Neighbours, SortingDoesNotDependOnThePreviousOrder) {
  for_crowds([]<int N>(const Crowd<N>& made) {
    auto first = made;
    lists_of(first);
    Random random(5);
    for (const int threads : {1, 2, 4}) {
      const Threads use(threads);
      auto second = made;
      for (const Group group : all_groups)
        second.store.permute(group, random.shuffled(second.store.range(group).size()));
      lists_of(second);
      EXPECT_TRUE(std::ranges::equal(first.store.ids(), second.store.ids()));
      EXPECT_TRUE(std::ranges::equal(first.store.raw(field::x::id), second.store.raw(field::x::id)));
      lists_of(second);
      EXPECT_TRUE(std::ranges::equal(first.store.ids(), second.store.ids())) << "sorted twice";
    }
  });
}

// Criterion: the very lists of before, from x_list, although x has moved since.
TEST(Neighbours, AreRebuiltFromTheListPositions) {
  for_crowds([]<int N>(Crowd<N> crowd) {
    for (const auto& options : all_ways<N>()) {
      const auto before = lists_of(crowd, options);
      Random random(9);
      for (auto& at : crowd.store.template get<field::x>()) at += random.vector<N>(0.01 * crowd.support);
      auto same = options;
      same.skin = 0.15;
      Neighbours<N> after(crowd.domain, same);
      after.rebuild_from_list_positions(crowd.store, before.support());
      EXPECT_EQ(after.support(), before.support());
      ASSERT_EQ(all_lists(before, crowd.store), all_lists(after, crowd.store));
    }
  });
}

// Criterion: a store in another order, as an older version wrote it, is read all the same.
TEST(Neighbours, AreRebuiltInAnyOrder) {
  for_crowds([]<int N>(Crowd<N> crowd) {
    Random random(17);
    std::ranges::copy(crowd.store.template get<field::x>(), crowd.store.template get<field::x_list>().begin());
    for (auto& at : crowd.store.template get<field::x_list>()) at = crowd.domain.wrapped(at);
    for (const Group group : all_groups) crowd.store.permute(group, random.shuffled(crowd.store.range(group).size()));
    Neighbours<N> reference(crowd.domain, {.search = "all_pairs", .lists = Lists::plain});
    reference.rebuild_from_list_positions(crowd.store, crowd.support);
    for (const Lists lists : {Lists::stored, Lists::free}) {
      Neighbours<N> neighbours(crowd.domain, {.lists = lists});
      neighbours.rebuild_from_list_positions(crowd.store, crowd.support);
      ASSERT_EQ(all_lists(neighbours, crowd.store), all_lists(reference, crowd.store));
    }
  });
}

// Criterion: one scratch serves groups, builds and neighbours in any order.
TEST(Neighbours, AScratchIsNotAnsweredFromWhatIsOld) {
  auto crowd = make_crowd<3>({.side = side<3>});
  auto other = make_crowd<3>({.side = side<3>}, 2);
  const typename Neighbours<3>::Options options{.lists = Lists::free};
  auto neighbours = lists_of(crowd, options);
  const auto others = lists_of(other, options);
  Neighbours<3>::Scratch scratch;
  Random random(21);
  for (int k = 0; k < 300; ++k) {
    if (k == 150) {
      for (auto& at : crowd.store.get<field::x>()) at += random.vector<3>(0.3 * crowd.support);
      neighbours.build(crowd.store, crowd.support);
    }
    const auto& [target, source] = group_pairs[random.bits() % 3];
    const bool which = random.bits() & 1;
    const auto& asked = which ? neighbours : others;
    const auto& store = which ? crowd.store : other.store;
    const std::size_t t = random.bits() % 8;
    std::vector<std::uint32_t> expected;
    asked.of(target, t, source, store, expected);
    ASSERT_TRUE(std::ranges::equal(asked.of(target, t, source, store, scratch), expected));
  }
}

// Criterion: automatic lists are stored where they fit into the memory allowed, and else not; the reason is told.
TEST(Neighbours, AutomaticListsKeepToTheMemoryAllowed) {
  auto crowd = make_crowd<2>({.side = side<2>});
  const auto roomy = lists_of(crowd);
  EXPECT_TRUE(roomy.stored());
  EXPECT_GT(roomy.pair_count(Group::fluid, Group::fluid), 0U);
  EXPECT_EQ(roomy.describe().find("stored lists, "), 0U) << roomy.describe();
  const auto tight = lists_of(crowd, {.list_memory = 1000});
  EXPECT_FALSE(tight.stored());
  EXPECT_LT(tight.bytes(), roomy.bytes());
  EXPECT_EQ(tight.describe().find("list-free: lists would need "), 0U) << tight.describe();
  EXPECT_EQ(all_lists(tight, crowd.store), all_lists(roomy, crowd.store));
  EXPECT_EQ(lists_of(crowd, {.lists = Lists::free}).describe(), "list-free: asked for");
  EXPECT_EQ(lists_of(crowd, {.lists = Lists::plain}).describe(), "plain: each particle asks cell_grid");
}

TEST(Neighbours, AnEmptyGroupHasNoNeighbours) {
  auto crowd = make_crowd<2>({.side = 6, .wall_layers = 0});
  for (const Lists lists : {Lists::stored, Lists::free, Lists::plain}) {
    const auto neighbours = lists_of(crowd, {.lists = lists});
    Neighbours<2>::Scratch scratch;
    EXPECT_TRUE(neighbours.of(Group::fluid, 0, Group::wall, crowd.store, scratch).empty());
    EXPECT_FALSE(neighbours.of(Group::fluid, 0, Group::fluid, crowd.store, scratch).empty());
    Crowd<2> nobody{{}, Domain<2>::unbounded(), 1};
    nobody.store.allocate(crowd.store.fields());
    EXPECT_EQ(lists_of(nobody, {.lists = lists}).pair_count(Group::fluid, Group::fluid), 0U);
  }
}

}  // namespace undine
