#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "undine/core/domain.hpp"
#include "undine/search/cell_frame.hpp"

namespace undine {

/// A point in a tree, and its index among the points that the tree was built for.
template <int N>
struct TreeElement {
  Vec<N> x;
  std::uint32_t point;
};

/// A part of space with its elements, that a tree is about to cut. A rule of cutting puts the parts that are not empty
/// in its place, the last ones first.
template <int N>
struct TreePart {
  Box<N> region;             ///< what this part of space is
  Box<N> bounds;             ///< the smallest box around its elements
  std::uint32_t begin, end;  ///< its elements, at least one
  int level = 0;             ///< cuts from the root
  int turn = 0;              ///< the axis whose turn it is

  double spread(int axis) const { return bounds.high[axis] - bounds.low[axis]; }
  double extent(int axis) const { return region.high[axis] - region.low[axis]; }
};

/// Where to cut between low and high: at most high, more than low.
inline double middle(double low, double high) {
  const double m = std::midpoint(low, high);
  return m > low ? m : high;
}

/// Takes away what lies on the far side of a plane from all elements; false if there are elements on both sides.
template <int N>
bool shrink(TreePart<N>& part, int axis, double plane) {
  if (part.bounds.high[axis] < plane) {
    part.region.high[axis] = std::min(part.region.high[axis], plane);
  } else if (part.bounds.low[axis] >= plane) {
    part.region.low[axis] = std::max(part.region.low[axis], plane);
  } else {
    return false;
  }
  return true;
}

/// The two halves of a part, either of which may be empty: x < plane, and the others.
template <int N>
struct TreeHalves {
  TreePart<N> low, high;
};
template <int N>
TreeHalves<N> halves(std::vector<TreeElement<N>>& elements, const TreePart<N>& part, int axis, double plane) {
  const auto first = elements.begin();
  const auto cut = std::partition(first + part.begin, first + part.end,
                                  [&](const TreeElement<N>& element) { return element.x[axis] < plane; });
  TreeHalves<N> two{part, part};
  two.low.end = two.high.begin = static_cast<std::uint32_t>(cut - first);
  two.low.region.high[axis] = two.high.region.low[axis] = plane;
  return two;
}

/// Points in a tree of boxes. How a box is cut is the business of a rule:
///
///   static void cut(std::vector<TreeElement<N>>& elements, TreePart<N> part, std::vector<TreePart<N>>& parts)
///
/// appends at least two parts that are not empty, and is only asked where elements differ in some coordinate. So every
/// node of the tree separates elements: coincident points share a leaf however many they are, and the depth is bounded
/// by how often a double can be halved. Neither building nor asking recurses.
template <int N>
class Tree {
 public:
  struct Node {
    Box<N> bounds;             ///< the smallest box around its elements
    std::uint32_t begin, end;  ///< its elements
    std::uint32_t next;        ///< the first node that is not below this one; of a leaf, the node after it
    int level;                 ///< the root has 0
  };
  /// More elements than that are cut.
  static constexpr std::uint32_t leaf_size = 12;

  /// Boxes shorter than `smallest` along every axis are not cut.
  template <class Rule>
  void build(std::span<const Vec<N>> points, const Domain<N>& domain, double smallest = 0) {
    take(points, domain);
    std::vector<TreePart<N>> parts;
    if (!points.empty()) {
      TreePart<N> root{};
      root.end = static_cast<std::uint32_t>(points.size());
      root.region = bounds_of(root);
      Rule::prepare(root.region);
      parts.push_back(root);
    }
    while (!parts.empty()) {
      TreePart<N> part = parts.back();
      parts.pop_back();
      part.bounds = bounds_of(part);
      nodes_.push_back({part.bounds, part.begin, part.end, 0, part.level});
      ++part.level;
      if (part.end - part.begin > leaf_size && worth_cutting(part, smallest)) Rule::cut(elements_, part, parts);
    }
    finish(points);
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<TreeElement<N>>& elements() const { return elements_; }
  bool is_leaf(std::uint32_t node) const { return nodes_[node].next == node + 1; }

  /// Where a point lies in the tree: inside the period, at most 1e150 away, and a number. No two points are farther
  /// from each other there than their nearest images are.
  Vec<N> place(const Vec<N>& x) const {
    Vec<N> at = domain_.wrapped(x);
    for (int k = 0; k < N; ++k) at[k] = at[k] == at[k] ? std::clamp(at[k], -farthest, farthest) : 0.0;
    return at;
  }
  /// By how much rounding may change the distance of a point, and of any of the tree, along periodic axes.
  Vec<N> rounding(const Vec<N>& x) const {
    Vec<N> slack;
    for (int k = 0; k < N; ++k) slack[k] = domain_.periodic[k] ? rounded * (std::abs(x[k]) + magnitude_[k]) : 0.0;
    return slack;
  }
  /// The same for two points of the tree.
  Vec<N> rounding() const { return rounding(magnitude_); }
  /// Whether rounding of a point is no worse than that of the tree's own.
  bool within_magnitude(const Vec<N>& x) const {
    for (int k = 0; k < N; ++k)
      if (domain_.periodic[k] && !(std::abs(x[k]) <= magnitude_[k])) return false;
    return true;
  }

  /// Calls f(node) for every leaf of which some point may be nearer than the radius to some point of the box, and for
  /// few others: hands the box down from the root, past all nodes out of its reach.
  template <class F>
  void for_each_leaf_near(const Box<N>& box, double radius, const Vec<N>& slack, F&& f) const {
    if (domain_.any_periodic()) {
      walk<true>(box, radius, slack, f);
    } else {
      walk<false>(box, radius, slack, f);
    }
  }
  /// The leaf whose box holds a place, or the number of nodes if there is none.
  std::uint32_t leaf_at(const Vec<N>& place) const;

  /// Appends the points of a leaf that are nearer than the radius.
  void append_near(std::uint32_t leaf, const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const;

  std::size_t bytes() const;

 private:
  static constexpr double farthest = 1e150;
  static constexpr double rounded = 8 * std::numeric_limits<double>::epsilon();
  static constexpr double farther = 1 + 1e-12;

  static bool worth_cutting(const TreePart<N>& part, double smallest) {
    for (int k = 0; k < N; ++k)
      if (part.spread(k) > 0 && part.spread(k) >= smallest) return true;
    return false;
  }
  void take(std::span<const Vec<N>> points, const Domain<N>& domain);
  Box<N> bounds_of(const TreePart<N>& part) const;
  void finish(std::span<const Vec<N>> points);

  /// The square of the distance of two boxes, over all periodic images.
  template <bool periodic>
  double gap_sq(const Box<N>& a, const Box<N>& b, const Vec<N>& slack) const {
    double sum = 0;
    for (int k = 0; k < N; ++k) {
      double gap = std::max(b.low[k] - a.high[k], a.low[k] - b.high[k]);
      if (periodic && domain_.periodic[k]) {
        const double around = domain_.length(k) - (std::max(a.high[k], b.high[k]) - std::min(a.low[k], b.low[k]));
        gap = std::min(gap, around) - slack[k];
      }
      sum += sq(std::max(gap, 0.0));
    }
    return sum;
  }
  template <bool periodic, class F>
  void walk(const Box<N>& box, double radius, const Vec<N>& slack, F& f) const {
    const double most = farther * sq(radius);
    for (std::uint32_t k = 0; k < nodes_.size();) {
      if (gap_sq<periodic>(box, nodes_[k].bounds, slack) > most) {
        k = nodes_[k].next;
      } else {
        if (is_leaf(k)) f(k);
        ++k;
      }
    }
  }

  Domain<N> domain_;
  Vec<N> magnitude_;  ///< of coordinates, along periodic axes
  std::vector<TreeElement<N>> elements_;
  std::vector<Node> nodes_;  ///< a node before those below it
};

extern template class Tree<1>;
extern template class Tree<2>;
extern template class Tree<3>;

}  // namespace undine
