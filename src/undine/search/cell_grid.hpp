#pragma once
#include "undine/search/search.hpp"

namespace undine {

/// Points sorted into cubic cells (counting sort; inside a cell by index). Used as a search, and to sort particles by
/// space.
template <int N>
class CellGrid final : public NeighbourSearch<N> {
 public:
  static constexpr Info info{"cell_grid", "Uniform grid of cells, O(n)", "cell = floor((x - x_min) / R)",
                             "Saalfeld (2012), 6.4"};

  void build(std::span<const Vec<N>> points, double radius, const Domain<N>& domain) override;
  void find(const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const override;
  std::size_t bytes() const override;

  /// Indices of the points cell by cell (first axis fastest), ascending inside a cell.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Where each cell begins in `order()`.
  std::span<const std::uint32_t> starts() const { return starts_; }

 private:
  using Cell = Vec<N, int>;
  Cell cell_of(const Vec<N>& x) const;
  std::size_t flat(const Cell& cell) const;
  void choose_cells(double radius);
  template <class F>
  void for_each_run(const Cell& low, const Cell& high, F&& f) const;

  std::span<const Vec<N>> points_;
  Domain<N> domain_;
  Vec<N> low_;
  Vec<N> cell_size_;
  Cell cells_;
  std::vector<std::uint32_t> order_, starts_;
  std::vector<Vec<N>> sorted_points_;  ///< in the order of `order_`, so that a cell's points lie side by side
};

extern template class CellGrid<1>;
extern template class CellGrid<2>;
extern template class CellGrid<3>;

}  // namespace undine
