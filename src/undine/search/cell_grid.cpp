#include "undine/search/cell_grid.hpp"

#include <algorithm>

namespace undine {

template <int N>
void CellGrid<N>::build(std::span<const Vec<N>> points, double radius, const Domain<N>& domain) {
  domain_ = domain;
  pencils_.build(CellFrame<N>(box_around(points), points.size(), radius, domain), points, {}, workspace_);
  sorted_points_.resize(points.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < points.size(); ++k) sorted_points_[k] = points[pencils_.order()[k]];
}

template <int N>
void CellGrid<N>::find(const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const {
  found.clear();
  const auto& frame = pencils_.frame();
  const double radius_sq = sq(radius);
  const bool periodic = domain_.any_periodic();
  std::size_t count = 0;
  pencils_.for_each_run(frame.cell_of(x), frame.reach(radius), [&](std::uint32_t begin, std::uint32_t end) {
    found.resize(count + end - begin);
    for (std::uint32_t k = begin; k < end; ++k) {
      const Vec<N> d = x - sorted_points_[k];
      found[count] = pencils_.order()[k];  // kept only if the count moves on: no branch to mispredict
      count += norm_sq(periodic ? domain_.nearest_image(d) : d) < radius_sq;
    }
  });
  found.resize(count);
  if (!std::is_sorted(found.begin(), found.end())) std::sort(found.begin(), found.end());
}

template <int N>
std::size_t CellGrid<N>::bytes() const {
  return pencils_.bytes() + workspace_.bytes() + sorted_points_.capacity() * sizeof(Vec<N>);
}

template class CellGrid<1>;
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace undine
