#include "undine/search/cell_frame.hpp"

#include <limits>

namespace undine {
namespace {

// Which side of a face a point lies on is subject to rounding. Cells are wider than the radius by more than that, so
// that two points nearer than the radius never have a whole cell between them.
constexpr double wider = 1 + 1e-6;
constexpr double farther = 1 + 1e-7;

}  // namespace

template <int N>
Box<N> box_around(std::span<const Vec<N>> points) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), largest = 1e150;
  Box<N> box;
  for (int k = 0; k < N; ++k) {
    double low = infinity, high = -infinity;
#pragma omp parallel for reduction(min : low) reduction(max : high) schedule(static)
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = points[i][k];
      const bool counts = std::abs(x) <= largest;
      low = std::min(low, counts ? x : infinity);
      high = std::max(high, counts ? x : -infinity);
    }
    box.low[k] = low <= high ? low : 0;
    box.high[k] = low <= high ? high : 0;
  }
  return box;
}

template <int N>
CellFrame<N>::CellFrame(const Box<N>& box, std::size_t count, double radius, const Domain<N>& domain) {
  Vec<N> width;
  const auto size_axis = [&](int k) {  // cells of at least this width
    const double fit = std::floor(length_[k] / width[k]);
    const double cells = periodic_[k] ? std::max(1.0, fit) : fit + 1;
    cells_[k] = static_cast<int>(std::min(cells, far));
    per_width_[k] = periodic_[k] ? cells_[k] / length_[k] : 1 / width[k];
    return cells;
  };
  for (int k = 0; k < N; ++k) {
    periodic_[k] = domain.periodic[k];
    low_[k] = periodic_[k] ? domain.low[k] : box.low[k];
    length_[k] = periodic_[k] ? domain.length(k) : box.high[k] - box.low[k];
    // A radius that is nothing beside the box, or is zero, must not ask for endless cells.
    width[k] = std::max({wider * radius, 1e-12 * length_[k], 1e-300});
  }
  width[0] /= cells_per_radius;
  size_axis(0);
  const double most = 4 * static_cast<double>(count) + 1e5;
  for (;;) {
    double pencils = 1;
    for (int k = 1; k < N; ++k) pencils *= size_axis(k);
    if (pencils <= most) return;
    // The axis with most cells has the outliers; the others keep their narrow ones.
    width[N == 3 && cells_[2] > cells_[1] ? 2 : 1] *= 1.5;
  }
}

template <int N>
auto CellFrame<N>::reach(double radius) const -> Cell {
  Cell cells;
  for (int k = 0; k < N; ++k)
    cells[k] = static_cast<int>(std::clamp(std::ceil(farther * radius * per_width_[k]), 0.0, 0.5 * far));
  return cells;
}

template Box<1> box_around(std::span<const Vec<1>>);
template Box<2> box_around(std::span<const Vec<2>>);
template Box<3> box_around(std::span<const Vec<3>>);
template class CellFrame<1>;
template class CellFrame<2>;
template class CellFrame<3>;

}  // namespace undine
