#pragma once
#include "undine/search/pencils.hpp"
#include "undine/search/search.hpp"

namespace undine {

/// Points sorted into the cells of a uniform grid.
template <int N>
class CellGrid final : public NeighbourSearch<N> {
 public:
  static constexpr Info info{"cell_grid", "Uniform grid of cells, O(n)", "cell = floor((x - x_min) / R)",
                             "Saalfeld (2012), 6.4"};

  void build(std::span<const Vec<N>> points, double radius, const Domain<N>& domain) override;
  void find(const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const override;
  std::size_t bytes() const override;

 private:
  Domain<N> domain_;
  Pencils<N> pencils_;
  Workspace workspace_;
  std::vector<Vec<N>> sorted_points_;  ///< in the order of the pencils, so that a cell's points lie side by side
};

extern template class CellGrid<1>;
extern template class CellGrid<2>;
extern template class CellGrid<3>;

}  // namespace undine
