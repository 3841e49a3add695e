#pragma once
#include <algorithm>
#include <cmath>
#include <span>

#include "undine/core/domain.hpp"

namespace undine {

/// The smallest box around points.
template <int N>
struct Box {
  Vec<N> low, high;
};

/// The box around points, whoever computes it; positions that are not finite do not count. The origin if there are
/// none.
template <int N>
Box<N> box_around(std::span<const Vec<N>> points);

/// Space cut into pencils along the first axis, one radius wide in the others, and each pencil into finer cells: points
/// near a point lie in few long runs of neighbouring cells. Along a periodic axis the cells fill one period.
template <int N>
class CellFrame {
 public:
  using Cell = Vec<N, int>;
  /// Cells of a pencil per radius: more of them fit the radius closer, and are emptier.
  static constexpr int cells_per_radius = 4;

  CellFrame() = default;
  /// For `count` points in a box, and searches within `radius`. Pencils are wider where points far apart would ask for
  /// more pencils than points.
  CellFrame(const Box<N>& box, std::size_t count, double radius, const Domain<N>& domain);

  /// The cell of a point. Along an axis that is not periodic it may lie outside of the box.
  Cell cell_of(const Vec<N>& x) const {
    Cell cell;
    for (int k = 0; k < N; ++k) {
      double at = x[k] - low_[k];
      if (periodic_[k]) at = std::max(0.0, at - length_[k] * std::floor(at / length_[k]));
      const double index = std::floor(at * per_width_[k]);
      // What is not a number lands in cell 0.
      const double safe = index > -far ? (index < far ? index : far) : (index <= -far ? -far : 0.0);
      cell[k] = static_cast<int>(safe);
      if (periodic_[k]) cell[k] = std::min(cell[k], cells_[k] - 1);
    }
    return cell;
  }

  std::size_t pencils() const {
    std::size_t count = 1;
    for (int k = 1; k < N; ++k) count *= static_cast<std::size_t>(cells_[k]);
    return count;
  }
  /// The pencil of a cell; of the outermost one for a cell outside of the box.
  std::size_t pencil_of(const Cell& cell) const {
    std::size_t index = 0;
    for (int k = N - 1; k > 0; --k)
      index =
          index * static_cast<std::size_t>(cells_[k]) + static_cast<std::size_t>(std::clamp(cell[k], 0, cells_[k] - 1));
    return index;
  }

  /// How many cells away a point within the radius can be.
  Cell reach(double radius) const;

  /// One or two ranges of cells, ascending, both ends included; `image` is by how many periods their points must be
  /// shifted to be on the side of the cell asked for.
  struct Ranges {
    int count = 0;
    int first[2], last[2], image[2];
  };
  /// The cells along an axis that are at most `reach` from a cell, each once. Where that would be some of them twice
  /// (`either_side`), all of them, and the image is meaningless.
  Ranges near(int axis, int cell, int reach) const {
    const int low = cell - reach, high = cell + reach, n = cells_[axis];
    if (!periodic_[axis]) {
      if (axis == 0) return {1, {low}, {high}, {0}};  // each pencil knows where it begins and ends
      return {std::max(low, 0) <= std::min(high, n - 1) ? 1 : 0, {std::max(low, 0)}, {std::min(high, n - 1)}, {0}};
    }
    if (either_side(axis, reach)) return {1, {0}, {n - 1}, {0}};
    if (low < 0) return {2, {0, low + n}, {high, n - 1}, {0, -1}};
    if (high >= n) return {2, {0, low}, {high - n, n - 1}, {1, 0}};
    return {1, {low}, {high}, {0}};
  }
  /// Whether the period is so short that a cell may be within reach by both sides.
  bool either_side(int axis, int reach) const { return periodic_[axis] && 2 * reach + 1 > cells_[axis]; }
  /// How many cells there are along an axis.
  int cells(int axis) const { return cells_[axis]; }
  /// Width of the cells along an axis, in m.
  double width(int axis) const { return 1 / per_width_[axis]; }

 private:
  static constexpr double far = 1 << 30;  ///< the last cell that is counted

  Vec<N> low_, length_, per_width_;
  Cell cells_;
  bool periodic_[N]{};
};

extern template class CellFrame<1>;
extern template class CellFrame<2>;
extern template class CellFrame<3>;

}  // namespace undine
