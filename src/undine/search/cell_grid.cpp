#include "undine/search/cell_grid.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace undine {
namespace {

// Which side of a face a point lies on is subject to rounding. Cells are wider than the radius by more than that, so that two points
// nearer than the radius never have a whole cell between them.
constexpr double wider = 1 + 1e-6;
constexpr double farther = 1 + 1e-7;

}  // namespace

template <int N>
void CellGrid<N>::build(std::span<const Vec<N>> points, double radius, const Domain<N>& domain) {
  points_ = points;
  domain_ = domain;
  choose_cells(radius);

  const std::size_t cell_count = std::accumulate(cells_.c, cells_.c + N, std::size_t{1}, std::multiplies<>());
  starts_.assign(cell_count + 1, 0);
  std::vector<std::uint32_t> cell(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    cell[i] = static_cast<std::uint32_t>(flat(cell_of(points[i])));
    ++starts_[cell[i] + 1];
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  order_.resize(points.size());
  auto next = starts_;
  for (std::size_t i = 0; i < points.size(); ++i) order_[next[cell[i]]++] = static_cast<std::uint32_t>(i);
}

/// Cells a little more than one radius wide over the points' bounding box (over the period on a periodic axis); wider where particles far
/// apart would ask for many more cells than there are points.
template <int N>
void CellGrid<N>::choose_cells(double radius) {
  Vec<N> high;
  for (int k = 0; k < N; ++k) {
    low_[k] = std::numeric_limits<double>::infinity();
    high[k] = -low_[k];
    for (const auto& x : points_) {
      low_[k] = std::min(low_[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
    if (points_.empty()) low_[k] = high[k] = 0;
    if (domain_.periodic[k]) {
      low_[k] = domain_.low[k];
      high[k] = domain_.high[k];
    }
  }
  const double most = 4.0 * static_cast<double>(points_.size()) + 1000.0;
  for (double width = wider * radius;; width *= 1.5) {
    double count = 1;
    for (int k = 0; k < N; ++k) {
      const double fit = std::floor((high[k] - low_[k]) / width);
      count *= domain_.periodic[k] ? std::max(1.0, fit) : fit + 1;
      cells_[k] = static_cast<int>(std::min(domain_.periodic[k] ? std::max(1.0, fit) : fit + 1, 1e9));
      cell_size_[k] = domain_.periodic[k] ? domain_.length(k) / cells_[k] : width;
    }
    if (count <= most) return;
  }
}

template <int N>
auto CellGrid<N>::cell_of(const Vec<N>& x) const -> Cell {
  Cell cell;
  for (int k = 0; k < N; ++k) {
    const double x_k = domain_.periodic[k] ? domain_.wrapped(x)[k] : x[k];
    const double index = std::floor((x_k - low_[k]) / cell_size_[k]);
    cell[k] = static_cast<int>(std::clamp(index, -1e9, 1e9));
    if (domain_.periodic[k]) cell[k] = std::min(cell[k], cells_[k] - 1);
  }
  return cell;
}

template <int N>
std::size_t CellGrid<N>::flat(const Cell& cell) const {
  std::size_t index = 0;
  for (int k = N - 1; k >= 0; --k) index = index * cells_[k] + std::clamp(cell[k], 0, cells_[k] - 1);
  return index;
}

template <int N>
void CellGrid<N>::find(const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (points_.empty()) return;
  const Cell centre = cell_of(x);
  Cell low, high;
  for (int k = 0; k < N; ++k) {
    const int reach = static_cast<int>(std::ceil(farther * radius / cell_size_[k]));
    low[k] = centre[k] - reach;
    high[k] = centre[k] + reach;
    if (!domain_.periodic[k]) {
      low[k] = std::max(low[k], 0);
      high[k] = std::min(high[k], cells_[k] - 1);
      if (low[k] > high[k]) return;
    } else if (high[k] - low[k] + 1 >= cells_[k]) {
      low[k] = 0;
      high[k] = cells_[k] - 1;
    }
  }
  scan(low, high, x, radius, found);
  // Points stored in cell order come out ascending already, but for periodic images.
  if (!std::is_sorted(found.begin(), found.end())) std::sort(found.begin(), found.end());
}

template <int N>
void CellGrid<N>::scan(const Cell& low, const Cell& high, const Vec<N>& x, double radius,
                       std::vector<std::uint32_t>& found) const {
  const double radius_sq = sq(radius);
  const bool periodic = domain_.any_periodic();
  Cell cell = low;
  for (;;) {
    for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0]) {
      Cell image = cell;
      for (int k = 0; k < N; ++k)
        if (domain_.periodic[k]) image[k] = (cell[k] + cells_[k]) % cells_[k];
      const std::size_t c = flat(image);
      for (std::uint32_t k = starts_[c]; k < starts_[c + 1]; ++k) {
        const Vec<N> d = x - points_[order_[k]];
        if (norm_sq(periodic ? domain_.nearest_image(d) : d) < radius_sq) found.push_back(order_[k]);
      }
    }
    int axis = 1;
    for (; axis < N; ++axis) {
      if (++cell[axis] <= high[axis]) break;
      cell[axis] = low[axis];
    }
    if (axis >= N) return;
  }
}

template <int N>
std::size_t CellGrid<N>::bytes() const {
  return (order_.capacity() + starts_.capacity()) * sizeof(std::uint32_t);
}

template class CellGrid<1>;
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace undine
