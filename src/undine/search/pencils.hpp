#pragma once
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "undine/core/workspace.hpp"
#include "undine/search/cell_frame.hpp"

namespace undine {

/// Points sorted by the cells of a frame: pencil by pencil, cell by cell along the pencil, inside a cell by id. The
/// order depends on positions and ids alone, not on the order before nor on the number of threads.
template <int N>
class Pencils {
 public:
  using Cell = typename CellFrame<N>::Cell;

  /// Without ids, points in one cell are ordered by index.
  void build(const CellFrame<N>& frame, std::span<const Vec<N>> points, std::span<const std::int64_t> ids,
             Workspace& workspace);

  const CellFrame<N>& frame() const { return frame_; }
  /// The index of the point at each place of the order.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Whether the points were in this order before.
  bool in_order() const { return in_order_; }

  /// Calls f(begin, end) for runs of places, ascending, that together hold every point at most `reach` cells from
  /// `cell`, each once, and few others.
  template <class F>
  void for_each_run(const Cell& cell, const Cell& reach, F&& f) const {
    for_each_run_of(cell, reach, [&](std::uint32_t begin, std::uint32_t end, const Cell&, bool) { f(begin, end); });
  }
  /// The same with f(begin, end, image, coarse): by how many periods those points must be shifted to be on the side of
  /// the cell; and whether others among them may be many cells away along the pencil, or on its other side.
  template <class F>
  void for_each_run_of(const Cell& cell, const Cell& reach, F&& f) const {
    const auto along = frame_.near(0, cell[0], reach[0]);
    Cell at = cell, image{};
    each_row(at, image, cell, reach, std::integral_constant<int, N - 1>{}, [&] {
      const Pencil& pencil = pencils_[frame_.pencil_of(at)];
      const bool coarse = pencil.shift > 1 || (pencil.shift > 0 && along.count > 1);
      int done = -1;  // two ranges may meet in one wide cell
      for (int r = 0; r < along.count; ++r) {
        const int low = std::max((along.first[r] >> pencil.shift) - pencil.first, done + 1);
        const int high = std::min((along.last[r] >> pencil.shift) - pencil.first, pencil.cells - 1);
        if (low > high) continue;
        done = high;
        image[0] = along.image[r];
        const std::uint32_t* starts = starts_.data() + pencil.starts_at;
        if (starts[low] < starts[high + 1]) f(starts[low], starts[high + 1], image, coarse);
      }
    });
  }

  std::size_t bytes() const;

 private:
  struct Pencil {
    std::size_t starts_at = 0;  ///< where in starts_: one per cell, and one more
    int first = 0, cells = 0;   ///< cells in use
    int shift = 0;              ///< 2^shift cells of the frame are one, where points are far apart
  };
  struct Place {
    int along;
    std::uint32_t point;
  };

  template <int axis, class F>
  void each_row(Cell& at, Cell& image, const Cell& cell, const Cell& reach, std::integral_constant<int, axis>,
                F&& f) const {
    if constexpr (axis == 0) {
      f();
    } else {
      const auto rows = frame_.near(axis, cell[axis], reach[axis]);
      for (int r = 0; r < rows.count; ++r) {
        image[axis] = rows.image[r];
        for (at[axis] = rows.first[r]; at[axis] <= rows.last[r]; ++at[axis])
          each_row(at, image, cell, reach, std::integral_constant<int, axis - 1>{}, f);
      }
    }
  }

  void sort_by_pencil(std::span<const Vec<N>> points);
  void choose_cells(std::size_t pencil);
  void sort_pencil(std::size_t pencil, std::span<const std::int64_t> ids);

  CellFrame<N> frame_;
  std::vector<Pencil> pencils_;
  std::vector<std::uint32_t> begins_;  ///< where each pencil begins, and the end
  std::vector<std::uint32_t> starts_, order_;
  bool in_order_ = true;

  struct Key {
    std::uint32_t pencil;
    int along;
  };
  std::span<Key> keys_;  ///< of the points, while they are sorted
  std::span<Place> places_;
  std::vector<std::uint32_t> counts_;
};

extern template class Pencils<1>;
extern template class Pencils<2>;
extern template class Pencils<3>;

}  // namespace undine
