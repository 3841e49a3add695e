#pragma once
#include <string_view>

#include "undine/search/tree.hpp"

namespace undine {

/// Octree: a box with more than so many elements is cut into eight equal ones, by a plane through its centre along each
/// axis. In 2-D a quadtree with four, in 1-D a binary tree with two. Saalfeld (2012), 6.1 and 6.2.
///   x_c = (x_min + x_max)/2 of the box, on every axis
/// Where all elements lie in one of the eight, that one takes the box's place; empty boxes are not kept.
struct OctreeRule {
  static constexpr std::string_view name = "octree";
  static constexpr std::string_view title = "Octree; quadtree in 2-D, binary tree in 1-D";
  static constexpr std::string_view equation = "x_c = (x_min + x_max)/2 of the box, on every axis";
  static constexpr std::string_view citation = "Saalfeld (2012), 6.1 and 6.2";

  /// The root is a cube, so all boxes are.
  template <int N>
  static void prepare(Box<N>& root) {
    double side = 0;
    for (int k = 0; k < N; ++k) side = std::max(side, root.high[k] - root.low[k]);
    for (int k = 0; k < N; ++k) root.high[k] = std::max(root.high[k], root.low[k] + side);
  }

  template <int N>
  static void cut(std::vector<TreeElement<N>>& elements, TreePart<N> part, std::vector<TreePart<N>>& parts) {
    for (;;) {
      Vec<N> centre;
      bool separates = false;
      for (int k = 0; k < N; ++k) {
        centre[k] = middle(part.region.low[k], part.region.high[k]);
        separates = !shrink(part, k, centre[k]) || separates;
      }
      if (separates) return cut_along<N - 1>(elements, part, centre, parts);
    }
  }

 private:
  template <int axis, int N>
  static void cut_along(std::vector<TreeElement<N>>& elements, const TreePart<N>& part, const Vec<N>& centre,
                        std::vector<TreePart<N>>& parts) {
    if (part.begin == part.end) return;
    if constexpr (axis < 0) {
      parts.push_back(part);
    } else if (part.bounds.high[axis] < centre[axis] || part.bounds.low[axis] >= centre[axis]) {
      cut_along<axis - 1>(elements, part, centre, parts);  // all on one side: shrunk to that half already
    } else {
      const auto two = halves(elements, part, axis, centre[axis]);
      cut_along<axis - 1>(elements, two.high, centre, parts);
      cut_along<axis - 1>(elements, two.low, centre, parts);
    }
  }
};

}  // namespace undine
