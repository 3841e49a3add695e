#pragma once
#include <string_view>

#include "undine/search/joined.hpp"
#include "undine/search/tree.hpp"

namespace undine {

/// Which axis a box of a k-d tree is cut across. Axes along which its elements do not differ are passed over: a plane
/// across them would separate nobody (Saalfeld (2012), 6.3, of elements in a plane or on a line).
namespace kd_axis {

/// The axis with the largest measure, the first of equals.
template <int N, class F>
int largest(const TreePart<N>& part, F&& measure) {
  int best = -1;
  for (int k = 0; k < N; ++k)
    if (part.spread(k) > 0 && (best < 0 || measure(k) > measure(best))) best = k;
  return best;
}

struct Rotate {
  static constexpr std::string_view name = "rotate", title = "axes in turn", equation = "axis = axis before + 1 mod N";
  template <int N>
  static int choose(const TreePart<N>& part) {
    int axis = part.turn % N;
    while (!(part.spread(axis) > 0)) axis = (axis + 1) % N;
    return axis;
  }
};
struct Extent {
  static constexpr std::string_view name = "extent", title = "across the box's longest side",
                                    equation = "axis = argmax(x_max - x_min of the box)";
  template <int N>
  static int choose(const TreePart<N>& part) {
    return largest(part, [&](int k) { return part.extent(k); });
  }
};
struct Spread {
  static constexpr std::string_view name = "spread", title = "across the largest spread of its elements",
                                    equation = "axis = argmax(x_max - x_min of the elements)";
  template <int N>
  static int choose(const TreePart<N>& part) {
    return largest(part, [&](int k) { return part.spread(k); });
  }
};

}  // namespace kd_axis

/// Where the plane stands. Elements with x < x_c are on its low side.
namespace kd_place {

struct Mid {
  static constexpr std::string_view name = "mid", title = "halving the box",
                                    equation = "x_c = (x_min + x_max)/2 of the box";
  template <int N>
  static double plane(std::vector<TreeElement<N>>&, const TreePart<N>& part, int axis) {
    return middle(part.region.low[axis], part.region.high[axis]);
  }
};
struct Centre {
  static constexpr std::string_view name = "centre", title = "amid its elements",
                                    equation = "x_c = (x_min + x_max)/2 of the elements";
  template <int N>
  static double plane(std::vector<TreeElement<N>>&, const TreePart<N>& part, int axis) {
    return middle(part.bounds.low[axis], part.bounds.high[axis]);
  }
};
/// Half of the elements on either side, but for those with the same coordinate, which stay together.
struct Median {
  static constexpr std::string_view name = "median", title = "half of its elements on either side",
                                    equation = "x_c = median of the elements";
  template <int N>
  static double plane(std::vector<TreeElement<N>>& elements, const TreePart<N>& part, int axis) {
    const auto first = elements.begin() + part.begin, last = elements.begin() + part.end;
    const auto half = first + (last - first) / 2;
    std::nth_element(first, half, last, [&](const auto& a, const auto& b) { return a.x[axis] < b.x[axis]; });
    const double low = part.bounds.low[axis];
    if (half->x[axis] > low) return half->x[axis];
    double above = part.bounds.high[axis];  // more than half have the least coordinate: the next one
    for (auto element = half; element != last; ++element)
      if (element->x[axis] > low) above = std::min(above, element->x[axis]);
    return above;
  }
};

}  // namespace kd_place

/// K-d tree: a box with more than so many elements is cut in two by a plane across one axis. Bentley (1975); the rules
/// are those of Saalfeld (2012), 6.3. A plane that separates nobody only makes the box smaller.
template <class Axis, class Place>
struct KdTreeRule {
  static constexpr std::string_view kd_tree = "kd_tree_", underscore = "_", colon = "k-d tree: ", comma = ", ",
                                    semicolon = "; ";
  static constexpr std::string_view name = Joined<kd_tree, Axis::name, underscore, Place::name>::text;
  static constexpr std::string_view title = Joined<colon, Axis::title, comma, Place::title>::text;
  static constexpr std::string_view equation = Joined<Axis::equation, semicolon, Place::equation>::text;
  static constexpr std::string_view citation = "Bentley (1975); Saalfeld (2012), 6.3";

  template <int N>
  static void prepare(Box<N>&) {}

  template <int N>
  static void cut(std::vector<TreeElement<N>>& elements, TreePart<N> part, std::vector<TreePart<N>>& parts) {
    for (;;) {
      const int axis = Axis::choose(part);
      part.turn = axis + 1;
      const double plane = Place::plane(elements, part, axis);
      if (shrink(part, axis, plane)) continue;
      const auto two = halves(elements, part, axis, plane);
      parts.push_back(two.high);
      parts.push_back(two.low);
      return;
    }
  }
};

}  // namespace undine
