#pragma once
#include <algorithm>

#include <gtest/gtest.h>

#include "undine/engine/neighbours.hpp"
#include "unit/engine/crowd.hpp"
#include "unit/under_sanitizer.hpp"

namespace undine::test {

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
Neighbours<N> lists_of(Crowd<N>& crowd, typename Neighbours<N>::Options options = {}) {
  options.skin = 0.15;
  Neighbours<N> neighbours(crowd.domain, options);
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

/// The lists of all targets, one after the other, each ending with -1.
template <int N>
std::vector<std::int64_t> all_lists(const Neighbours<N>& neighbours, const Store<N>& store) {
  std::vector<std::int64_t> all;
  typename Neighbours<N>::Scratch scratch;
  for (const auto& [target, source] : group_pairs)
    for (std::size_t t = 0; t < store.range(target).size(); ++t) {
      const auto list = neighbours.of(target, t, source, store, scratch);
      all.insert(all.end(), list.begin(), list.end());
      all.push_back(-1);
    }
  return all;
}

/// Every way to the lists: search, stored or not, instruction set. Searches other than the grid are asked point by
/// point with any lists and instructions.
template <int N>
std::vector<typename Neighbours<N>::Options> all_ways() {
  std::vector<typename Neighbours<N>::Options> ways;
  for (const auto& info : search_infos())
    for (const Lists lists : {Lists::stored, Lists::free, Lists::plain})
      for (const auto set : {InstructionSet::basic, InstructionSet::avx2, InstructionSet::avx512})
        if (can_run(set) && (info.name == "cell_grid" || (set == InstructionSet::basic && lists != Lists::free)))
          ways.push_back({.search = std::string(info.name), .lists = lists, .instructions = set});
  return ways;
}

/// Criterion: the same lists by every way and for any number of threads; every pair within the list radius is on them,
/// and no pair farther apart than a thousandth more (`rounding` where double itself is no finer); ascending.
template <int N>
void expect_all_pairs(const Crowd<N>& made, double rounding = 0) {
  std::vector<std::int64_t> expected;
  for (const auto& options : all_ways<N>())
    for (const int threads : {1, 2, 4}) {
      if (threads > 1 && (options.lists != Lists::stored || (under_sanitizer && options.search != "cell_grid")))
        continue;
      const Threads use(threads);
      auto crowd = made;
      const auto neighbours = lists_of(crowd, options);
      EXPECT_DOUBLE_EQ(neighbours.list_radius(), 1.15 * crowd.support);
      const auto lists = all_lists(neighbours, crowd.store);
      if (expected.empty()) {
        expected = lists;
        auto next = lists.begin();
        for (const auto& [target, source] : group_pairs)
          for (std::size_t t = 0; t < crowd.store.range(target).size(); ++t, ++next) {
            const auto begin = next;
            next = std::find(next, lists.end(), -1);
            const auto x = crowd.store.template get<field::x>()[crowd.store.range(target).begin + t];
            const auto needed = within(crowd, x, source, neighbours.list_radius() - rounding);
            const auto allowed = within(crowd, x, source, 1.001 * neighbours.list_radius() + rounding);
            ASSERT_TRUE(std::adjacent_find(begin, next, std::greater_equal<>()) == next);
            ASSERT_TRUE(std::includes(begin, next, needed.begin(), needed.end()));
            ASSERT_TRUE(std::includes(allowed.begin(), allowed.end(), begin, next));
          }
      }
      ASSERT_EQ(lists, expected) << options.search << ", way " << static_cast<int>(options.lists) << ", instructions "
                                 << static_cast<int>(options.instructions) << ", threads " << threads;
    }
}

}  // namespace undine::test
