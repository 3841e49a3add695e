#include "undine/engine/neighbours.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "unit/engine/crowd.hpp"

namespace undine {
namespace {

using test::Crowd;
using test::make_crowd;
using test::Random;

template <int N>
constexpr int side = N == 1   ? 60
                     : N == 2 ? 14
                              : 9;

/// Calls f.operator()<N>(crowd) for open and periodic crowds in every dimension.
template <class F>
void for_crowds(F f) {
  const auto in_dimension = [&]<int N>() {
    for (const bool periodic : {false, true}) {
      SCOPED_TRACE(std::to_string(N) + (periodic ? "-D periodic" : "-D open"));
      f.template operator()<N>(make_crowd<N>({.side = side<N>, .wall_layers = 2, .periodic = periodic}));
    }
  };
  in_dimension.template operator()<1>();
  in_dimension.template operator()<2>();
  in_dimension.template operator()<3>();
}

template <int N>
Neighbours<N> lists_of(Crowd<N>& crowd, const std::string& search = "cell_grid", bool store_lists = true) {
  Neighbours<N> neighbours(crowd.domain, {.search = search, .skin = 0.15, .store_lists = store_lists});
  neighbours.build(crowd.store, crowd.support);
  return neighbours;
}

/// Pairs of groups that act on each other.
constexpr std::pair<Group, Group> group_pairs[] = {
    {Group::fluid, Group::fluid}, {Group::fluid, Group::wall}, {Group::wall, Group::fluid}};

template <int N>
std::vector<std::uint32_t> within(const Crowd<N>& crowd, const Vec<N>& at, Group group, double radius) {
  std::vector<std::uint32_t> found;
  const auto x = crowd.store.template get<field::x>();
  for (std::size_t i = crowd.store.range(group).begin; i < crowd.store.range(group).end; ++i)
    if (norm_sq(crowd.domain.nearest_image(at - x[i])) < sq(radius)) found.push_back(static_cast<std::uint32_t>(i));
  return found;
}

// Criterion: exactly the pairs nearer than the list radius, ascending, whatever the search and whether lists are
// stored.
TEST(Neighbours, ListsAreAllPairsWithinTheListRadius) {
  for_crowds([]<int N>(const Crowd<N>& made) {
    for (const auto& info : search_infos())
      for (const bool store_lists : {true, false}) {
        auto crowd = made;
        const auto neighbours = lists_of(crowd, std::string(info.name), store_lists);
        EXPECT_DOUBLE_EQ(neighbours.list_radius(), 1.15 * crowd.support);
        std::vector<std::uint32_t> scratch;
        for (const auto& [target, source] : group_pairs) {
          const IndexRange targets = crowd.store.range(target);
          for (std::size_t t = 0; t < targets.size(); ++t) {
            const auto list = neighbours.of(target, t, source, crowd.store, scratch);
            const auto x = crowd.store.template get<field::x>()[targets.begin + t];
            ASSERT_TRUE(std::ranges::equal(list, within(crowd, x, source, neighbours.list_radius()))) << info.name;
          }
        }
      }
  });
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
    std::vector<std::uint32_t> scratch;
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

// Criterion: the same order of ids from any order before, and equal cells side by side in that order.
TEST(Neighbours, SortingDoesNotDependOnThePreviousOrder) {
  for_crowds([]<int N>(const Crowd<N>& made) {
    auto first = made, second = made;
    Random random(5);
    for (const Group group : all_groups) second.store.permute(group, random.shuffled(second.store.range(group).size()));
    lists_of(first);
    lists_of(second);
    EXPECT_TRUE(std::ranges::equal(first.store.ids(), second.store.ids()));
    EXPECT_TRUE(std::ranges::equal(first.store.raw(field::x::id), second.store.raw(field::x::id)));
    lists_of(second);
    EXPECT_TRUE(std::ranges::equal(first.store.ids(), second.store.ids())) << "sorted twice";
  });
}

// Criterion: the very lists of before, from x_list, although x has moved since.
TEST(Neighbours, AreRebuiltFromTheListPositions) {
  for_crowds([]<int N>(Crowd<N> crowd) {
    const auto before = lists_of(crowd);
    Random random(9);
    for (auto& at : crowd.store.template get<field::x>()) at += random.vector<N>(0.01 * crowd.support);
    Neighbours<N> after(crowd.domain, {.search = "cell_grid", .skin = 0.15, .store_lists = true});
    after.rebuild_from_list_positions(crowd.store, before.support());
    EXPECT_EQ(after.support(), before.support());
    std::vector<std::uint32_t> scratch;
    for (const auto& [target, source] : group_pairs)
      for (std::size_t t = 0; t < crowd.store.range(target).size(); ++t)
        ASSERT_TRUE(std::ranges::equal(before.of(target, t, source, crowd.store, scratch),
                                       after.of(target, t, source, crowd.store, scratch)));
  });
}

TEST(Neighbours, AnEmptyGroupHasNoNeighbours) {
  auto crowd = make_crowd<2>({.side = 6, .wall_layers = 0});
  const auto neighbours = lists_of(crowd);
  std::vector<std::uint32_t> scratch;
  EXPECT_TRUE(neighbours.of(Group::fluid, 0, Group::wall, crowd.store, scratch).empty());
  EXPECT_FALSE(neighbours.of(Group::fluid, 0, Group::fluid, crowd.store, scratch).empty());
  Crowd<2> nobody{{}, Domain<2>::unbounded(), 1};
  nobody.store.allocate(crowd.store.fields());
  EXPECT_EQ(lists_of(nobody).pair_count(Group::fluid, Group::fluid), 0U);
}

}  // namespace
}  // namespace undine
