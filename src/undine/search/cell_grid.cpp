#include "undine/search/cell_grid.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace undine {
namespace {

// Which side of a face a point lies on is subject to rounding. Cells are wider than the radius by more than that, so
// that two points nearer than the radius never have a whole cell between them.
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
  sorted_points_.resize(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) sorted_points_[k] = points[order_[k]];
}

/// Cells a little more than one radius wide over the points' bounding box (over the period on a periodic axis); wider
/// where particles far apart would ask for many more cells than there are points.
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
  std::size_t candidates = 0;
  for_each_run(low, high, [&](std::uint32_t begin, std::uint32_t end) { candidates += end - begin; });
  if (candidates == 0) return;
  thread_local std::vector<std::uint32_t>
      near;  // keeps its size: growing it in each query would cost more than the query
  if (near.size() < candidates) near.resize(candidates);
  std::size_t count = 0;
  const double radius_sq = sq(radius);
  const bool periodic = domain_.any_periodic();
  for_each_run(low, high, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t k = begin; k < end; ++k) {
      const Vec<N> d = x - sorted_points_[k];
      near[count] = order_[k];  // kept only if the count moves on: no branch to mispredict
      count += norm_sq(periodic ? domain_.nearest_image(d) : d) < radius_sq;
    }
  });
  found.assign(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count));
  // Points stored in cell order come out ascending already, but for periodic images.
  if (!std::is_sorted(found.begin(), found.end())) std::sort(found.begin(), found.end());
}

/// Calls f(begin, end) for the points of the cells from low to high (both included), a row of cells at a time.
template <int N>
template <class F>
void CellGrid<N>::for_each_run(const Cell& low, const Cell& high, F&& f) const {
  Cell cell = low;
  for (;;) {
    Cell image = cell;
    for (int k = 0; k < N; ++k)
      if (domain_.periodic[k]) image[k] = (cell[k] + cells_[k]) % cells_[k];
    if (domain_.periodic[0]) {
      for (int c = low[0]; c <= high[0]; ++c) {
        image[0] = (c + cells_[0]) % cells_[0];
        f(starts_[flat(image)], starts_[flat(image) + 1]);
      }
    } else {
      const std::size_t row = flat(image);
      f(starts_[row], starts_[row + static_cast<std::size_t>(high[0] - low[0]) + 1]);
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
  return (order_.capacity() + starts_.capacity()) * sizeof(std::uint32_t) + sorted_points_.capacity() * sizeof(Vec<N>);
}

template class CellGrid<1>;
template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace undine
