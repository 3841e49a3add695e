#include "undine/search/pencils.hpp"

#include <algorithm>
#include <utility>

#include <omp.h>

namespace undine {

template <int N>
void Pencils<N>::build(const CellFrame<N>& frame, std::span<const Vec<N>> points, std::span<const std::int64_t> ids,
                       Workspace& workspace) {
  frame_ = frame;
  const auto work = workspace.take<std::byte>(points.size() * (sizeof(Key) + sizeof(Place)));
  keys_ = {reinterpret_cast<Key*>(work.data()), points.size()};
  places_ = {reinterpret_cast<Place*>(work.data() + points.size() * sizeof(Key)), points.size()};
  sort_by_pencil(points);
  const std::size_t count = pencils_.size();
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t p = 0; p < count; ++p) choose_cells(p);
  std::size_t starts = 0;
  for (Pencil& pencil : pencils_) {
    pencil.starts_at = starts;
    starts += static_cast<std::size_t>(pencil.cells) + 1;
  }
  starts_.resize(starts);
  order_.resize(points.size());
#pragma omp parallel for schedule(dynamic, 8)
  for (std::size_t p = 0; p < count; ++p) sort_pencil(p, ids);
  bool in_order = true;
#pragma omp parallel for reduction(&& : in_order) schedule(static)
  for (std::size_t k = 0; k < order_.size(); ++k) in_order = in_order && order_[k] == k;
  in_order_ = in_order;
}

/// Counting sort by pencil; inside a pencil by index.
template <int N>
void Pencils<N>::sort_by_pencil(std::span<const Vec<N>> points) {
  const std::size_t n = points.size(), pencil_count = frame_.pencils();
  pencils_.resize(pencil_count);
  begins_.resize(pencil_count + 1);
  // One table of counts for each chunk of points; no more chunks than keep all tables together about as large as the
  // points.
  const std::size_t chunks =
      std::clamp<std::size_t>(2 * n / pencil_count, 1, static_cast<std::size_t>(omp_get_max_threads()));
  counts_.assign(chunks * pencil_count, 0);
#pragma omp parallel for schedule(static, 1)
  for (std::size_t c = 0; c < chunks; ++c) {
    std::uint32_t* count = counts_.data() + c * pencil_count;
    for (std::size_t i = c * n / chunks; i < (c + 1) * n / chunks; ++i) {
      const Cell cell = frame_.cell_of(points[i]);
      const auto pencil = static_cast<std::uint32_t>(frame_.pencil_of(cell));
      keys_[i] = {pencil, cell[0]};
      ++count[pencil];
    }
  }
  std::uint32_t next = 0;
  for (std::size_t p = 0; p < pencil_count; ++p) {
    begins_[p] = next;
    for (std::size_t c = 0; c < chunks; ++c) next += std::exchange(counts_[c * pencil_count + p], next);
  }
  begins_[pencil_count] = next;
#pragma omp parallel for schedule(static, 1)
  for (std::size_t c = 0; c < chunks; ++c) {
    std::uint32_t* place = counts_.data() + c * pencil_count;
    for (std::size_t i = c * n / chunks; i < (c + 1) * n / chunks; ++i)
      places_[place[keys_[i].pencil]++] = {keys_[i].along, static_cast<std::uint32_t>(i)};
  }
}

/// The cells of a pencil from its first to its last point; wider ones where they would be many more than its points.
template <int N>
void Pencils<N>::choose_cells(std::size_t p) {
  const std::uint32_t begin = begins_[p], end = begins_[p + 1];
  Pencil& pencil = pencils_[p];
  pencil.first = pencil.cells = pencil.shift = 0;
  if (begin == end) return;
  int low = places_[begin].along, high = low;
  for (std::uint32_t k = begin; k < end; ++k) {
    low = std::min(low, places_[k].along);
    high = std::max(high, places_[k].along);
  }
  const std::int64_t most = 4 * std::int64_t{end - begin} + 16;
  const auto cells = [&] { return (std::int64_t{high} >> pencil.shift) - (low >> pencil.shift) + 1; };
  while (cells() > most) ++pencil.shift;
  pencil.first = low >> pencil.shift;
  pencil.cells = static_cast<int>(cells());
}

template <int N>
void Pencils<N>::sort_pencil(std::size_t p, std::span<const std::int64_t> ids) {
  const Pencil& pencil = pencils_[p];
  std::uint32_t* starts = starts_.data() + pencil.starts_at;
  const std::uint32_t begin = begins_[p], end = begins_[p + 1];
  const auto cell_of = [&](const Place& place) { return (place.along >> pencil.shift) - pencil.first; };
  std::fill_n(starts, pencil.cells + 1, 0U);
  starts[0] = begin;
  for (std::uint32_t k = begin; k < end; ++k) ++starts[cell_of(places_[k]) + 1];
  // starts[c + 1] is where the next point of cell c goes, hence at last where cell c + 1 begins.
  std::uint32_t next = begin;
  for (int c = 1; c <= pencil.cells; ++c) next += std::exchange(starts[c], next);
  for (std::uint32_t k = begin; k < end; ++k) order_[starts[cell_of(places_[k]) + 1]++] = places_[k].point;
  if (ids.empty()) return;
  const auto earlier = [&](std::uint32_t a, std::uint32_t b) { return ids[a] < ids[b]; };
  for (int c = 0; c < pencil.cells; ++c) {
    const auto first = order_.begin() + starts[c], last = order_.begin() + starts[c + 1];
    if (!std::is_sorted(first, last, earlier)) std::sort(first, last, earlier);
  }
}

template <int N>
std::size_t Pencils<N>::bytes() const {
  return pencils_.capacity() * sizeof(Pencil) +
         (begins_.capacity() + starts_.capacity() + order_.capacity() + counts_.capacity()) * sizeof(std::uint32_t);
}

template class Pencils<1>;
template class Pencils<2>;
template class Pencils<3>;

}  // namespace undine
