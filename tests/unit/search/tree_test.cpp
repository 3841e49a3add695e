#include "undine/search/tree.hpp"

#include <set>

#include <gtest/gtest.h>

#include "undine/search/kd_tree.hpp"
#include "undine/search/octree.hpp"
#include "unit/engine/crowd.hpp"

namespace undine {
namespace {

using namespace kd_axis;
using namespace kd_place;
using test::Random;

/// Calls f.operator()<Rule>() for every rule of cutting.
template <class F>
void for_each_rule(F f) {
  const auto rule = [&]<class Rule>() {
    SCOPED_TRACE(std::string(Rule::name));
    f.template operator()<Rule>();
  };
  rule.template operator()<OctreeRule>();
  rule.template operator()<KdTreeRule<Rotate, Mid>>();
  rule.template operator()<KdTreeRule<Rotate, Centre>>();
  rule.template operator()<KdTreeRule<Rotate, Median>>();
  rule.template operator()<KdTreeRule<Extent, Mid>>();
  rule.template operator()<KdTreeRule<Extent, Centre>>();
  rule.template operator()<KdTreeRule<Extent, Median>>();
  rule.template operator()<KdTreeRule<Spread, Mid>>();
  rule.template operator()<KdTreeRule<Spread, Centre>>();
  rule.template operator()<KdTreeRule<Spread, Median>>();
}

template <class Rule, int N>
Tree<N> tree_of(const std::vector<Vec<N>>& points) {
  Tree<N> tree;
  tree.template build<Rule>(points, Domain<N>::unbounded());
  return tree;
}

template <int N>
std::vector<std::uint32_t> children(const Tree<N>& tree, std::uint32_t node) {
  std::vector<std::uint32_t> all;
  for (auto k = node + 1; k < tree.nodes()[node].next; k = tree.nodes()[k].next) all.push_back(k);
  return all;
}

template <int N>
int depth(const Tree<N>& tree) {
  int deepest = 0;
  for (const auto& node : tree.nodes()) deepest = std::max(deepest, node.level);
  return deepest;
}

/// How many elements all levels together went through: the cost of the build.
template <int N>
double work(const Tree<N>& tree) {
  double sum = 0;
  for (const auto& node : tree.nodes()) sum += node.end - node.begin;
  return sum;
}

/// Criterion: boxes fit their elements; children share their parent's elements out, at least two of them; leaves have
/// few elements unless these coincide; every point is in one leaf.
template <int N>
void expect_sound(const Tree<N>& tree, std::size_t points) {
  std::set<std::uint32_t> seen;
  const auto& nodes = tree.nodes();
  for (std::uint32_t k = 0; k < nodes.size(); ++k) {
    Box<N> box{tree.elements()[nodes[k].begin].x, tree.elements()[nodes[k].begin].x};
    for (auto i = nodes[k].begin; i < nodes[k].end; ++i)
      for (int d = 0; d < N; ++d) {
        box.low[d] = std::min(box.low[d], tree.elements()[i].x[d]);
        box.high[d] = std::max(box.high[d], tree.elements()[i].x[d]);
      }
    ASSERT_EQ(box.low, nodes[k].bounds.low);
    ASSERT_EQ(box.high, nodes[k].bounds.high);
    if (tree.is_leaf(k)) {
      ASSERT_TRUE(nodes[k].end - nodes[k].begin <= Tree<N>::leaf_size || box.low == box.high);
      for (auto i = nodes[k].begin; i < nodes[k].end; ++i) ASSERT_TRUE(seen.insert(tree.elements()[i].point).second);
      continue;
    }
    const auto below = children(tree, k);
    ASSERT_GE(below.size(), 2U);
    auto begin = nodes[k].begin;
    for (const auto child : below) {
      ASSERT_EQ(nodes[child].begin, begin);
      ASSERT_EQ(nodes[child].level, nodes[k].level + 1);
      begin = nodes[child].end;
    }
    ASSERT_EQ(begin, nodes[k].end);
  }
  EXPECT_EQ(seen.size(), points);
}

/// The axis across which a node is cut: its two children are apart there.
template <int N>
int axis_of_cut(const Tree<N>& tree, std::uint32_t node) {
  const auto below = children(tree, node);
  for (int k = 0; k < N && below.size() == 2; ++k)
    if (tree.nodes()[below[0]].bounds.high[k] < tree.nodes()[below[1]].bounds.low[k]) return k;
  return -1;
}

template <int N>
std::vector<Vec<N>> random_points(int n) {
  Random random(5);
  std::vector<Vec<N>> points;
  for (int k = 0; k < n; ++k) points.push_back(random.vector<N>(k % 2 ? 1 : 0.01));
  return points;
}

}  // namespace

TEST(Tree, IsSound) {
  for_each_rule([]<class Rule>() {
    for (const int n : {0, 1, 12, 13, 500, 3000}) {
      expect_sound(tree_of<Rule>(random_points<1>(n)), n);
      expect_sound(tree_of<Rule>(random_points<2>(n)), n);
      expect_sound(tree_of<Rule>(random_points<3>(n)), n);
    }
  });
}

// Criterion: one leaf, one pass.
TEST(Tree, CoincidentPointsShareALeafHoweverMany) {
  const std::vector<Vec<3>> points(100000, Vec<3>{{0.1, 0.2, 0.3}});
  for_each_rule([&]<class Rule>() { EXPECT_EQ(tree_of<Rule>(points).nodes().size(), 1U); });
}

// Criterion: on a line, in a plane, on few places and with an outlier far away, as deep and as costly as with points
// spread out: every cut separates somebody.
TEST(Tree, DegenerateSetsAreCutNoMoreThanOthers) {
  constexpr int n = 20000;
  Random random(3);
  std::vector<std::vector<Vec<3>>> sets(5);
  for (int k = 0; k < n; ++k) {
    const double t = random.between(0, 1), s = random.between(0, 1);
    sets[0].push_back({{t, 0.5, 0.5}});
    sets[1].push_back({{0.1, t, s}});
    sets[2].push_back({{0.1 * (k % 3), 0.2, -0.1 * (k % 7)}});
    sets[3].push_back(k == 0 ? Vec<3>{{1e12, 0, 0}} : random.vector<3>(1));
    sets[4].push_back({{0.1 * std::floor(10 * t), 0.1 * std::floor(10 * s), 0.1 * (k % 10)}});
  }
  for_each_rule([&]<class Rule>() {
    for (const auto& set : sets) {
      const auto tree = tree_of<Rule>(set);
      expect_sound(tree, n);
      EXPECT_LE(depth(tree), 24);
      EXPECT_LE(work(tree), 24.0 * n);
    }
  });
}

// Criterion: a set that halving separates one by one, over all powers of two that a double has, is taken apart without
// trouble, and no deeper than it has points.
TEST(Tree, TheDeepestTreeIsBuilt) {
  std::vector<Vec<2>> points(1, Vec<2>{});
  for (int k = -1074; k < 490; ++k) points.push_back({{std::ldexp(1.0, k), std::ldexp(1.0, k)}});
  for_each_rule([&]<class Rule>() {
    const auto tree = tree_of<Rule>(points);
    expect_sound(tree, points.size());
    EXPECT_LE(depth(tree), static_cast<int>(points.size()));
  });
}

TEST(Tree, TheMedianBalances) {
  const auto points = random_points<3>(4096);
  const auto check = [&]<class Rule>() {
    const auto tree = tree_of<Rule>(points);
    EXPECT_EQ(depth(tree), 9);  // 4096 / 2^9 = 8, at most 12
    for (const auto& node : tree.nodes()) EXPECT_EQ(node.end - node.begin, 4096U >> node.level);
  };
  check.operator()<KdTreeRule<Rotate, Median>>();
  check.operator()<KdTreeRule<Extent, Median>>();
  check.operator()<KdTreeRule<Spread, Median>>();
}

// A long box first, then in its half a group that is flat in a box that is not.
TEST(Tree, AxesFollowTheirRules) {
  std::vector<Vec<2>> points;
  for (int k = 0; k < 20; ++k) {
    points.push_back({{0.005 * k, 0.02 * (7 * k % 20)}});
    points.push_back({{1, 0.02 * k}});
  }
  using Axes = std::pair<int, int>;
  const auto cuts = [&]<class Rule>() {
    const auto tree = tree_of<Rule>(points);
    return Axes{axis_of_cut(tree, 0), axis_of_cut(tree, 1)};
  };
  EXPECT_EQ((cuts.operator()<KdTreeRule<Rotate, Centre>>()), (Axes{0, 1}));
  EXPECT_EQ((cuts.operator()<KdTreeRule<Extent, Centre>>()), (Axes{0, 0}));  // up to the plane at 0.5 it is longer
  EXPECT_EQ((cuts.operator()<KdTreeRule<Spread, Centre>>()), (Axes{0, 1}));
  for (auto& x : points) std::swap(x[0], x[1]);
  EXPECT_EQ((cuts.operator()<KdTreeRule<Rotate, Centre>>()), (Axes{0, 1}));
  EXPECT_EQ((cuts.operator()<KdTreeRule<Extent, Centre>>()), (Axes{1, 1}));
  EXPECT_EQ((cuts.operator()<KdTreeRule<Spread, Centre>>()), (Axes{1, 0}));
}

// Thirteen points from 0 to 9, another at 100; where the first plane stands and the second, told by who is left of it.
TEST(Tree, PlanesFollowTheirRules) {
  std::vector<Vec<1>> points{{{100}}};
  for (int k = 0; k < 13; ++k) points.push_back({{0.75 * k}});
  for (int k = 0; k < 13; ++k) points.push_back({{40 + 0.75 * k}});
  const auto lows = [&]<class Rule>() {
    const auto tree = tree_of<Rule>(points);
    const auto low = tree.nodes()[1];
    return std::pair{low.end - low.begin, tree.nodes()[2].end - tree.nodes()[2].begin};
  };
  using Counts = std::pair<std::uint32_t, std::uint32_t>;
  // Below 50 are 26; of those, below 25 (and 24.5 amid them) 13; the median of 27 has 13 below, of those 13 it has 6.
  EXPECT_EQ((lows.operator()<KdTreeRule<Spread, Mid>>()), (Counts{26, 13}));
  EXPECT_EQ((lows.operator()<KdTreeRule<Spread, Centre>>()), (Counts{26, 13}));
  EXPECT_EQ((lows.operator()<KdTreeRule<Spread, Median>>()), (Counts{13, 6}));
  EXPECT_EQ((lows.operator()<OctreeRule>()), (Counts{26, 13}));
  // The high half of the box is from 40.5 to 81, its middle at 60.75; its elements are from 60 to 81, amid them
  // is 70.5.
  points = {{{0}}};
  for (int k = 0; k < 15; ++k) points.push_back({{60 + 1.5 * k}});
  const auto second = [&]<class Rule>() {
    const auto tree = tree_of<Rule>(points);
    const auto low = tree.nodes()[children(tree, children(tree, 0)[1])[0]];
    return low.end - low.begin;
  };
  EXPECT_EQ((second.operator()<KdTreeRule<Extent, Mid>>()), 1U);
  EXPECT_EQ((second.operator()<KdTreeRule<Extent, Centre>>()), 7U);
  EXPECT_EQ(second.operator()<OctreeRule>(), 1U);
  // More than half have the least coordinate: they stay together.
  points.assign(14, {{0}});
  for (int k = 1; k < 7; ++k) points.push_back({{1.0 * k}});
  EXPECT_EQ((lows.operator()<KdTreeRule<Rotate, Median>>()), (Counts{14, 6}));
}

}  // namespace undine
