#include "undine/engine/neighbours.hpp"

#include <algorithm>
#include <numeric>

#include "undine/search/cell_grid.hpp"

namespace undine {
namespace {

using field::x_list;

}  // namespace

template <class Find>
void NeighbourList::fill(std::size_t targets, std::size_t offset, Find&& find) {
  parts_.resize((targets + targets_per_part - 1) / targets_per_part);
#pragma omp parallel
  {
    std::vector<std::uint32_t> found;
#pragma omp for schedule(dynamic, 1)
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      Part& part = parts_[p];
      part.starts.assign(1, 0);
      part.indices.clear();
      for (std::size_t t = p * targets_per_part; t < std::min(targets, (p + 1) * targets_per_part); ++t) {
        find(t, found);
        for (auto& j : found) j += static_cast<std::uint32_t>(offset);
        part.indices.insert(part.indices.end(), found.begin(), found.end());
        part.starts.push_back(static_cast<std::uint32_t>(part.indices.size()));
      }
    }
  }
}

std::size_t NeighbourList::pairs() const {
  std::size_t total = 0;
  for (const Part& part : parts_) total += part.indices.size();
  return total;
}

std::size_t NeighbourList::bytes() const {
  std::size_t total = 0;
  for (const Part& part : parts_) total += (part.starts.capacity() + part.indices.capacity()) * sizeof(std::uint32_t);
  return total;
}

template <int N>
Neighbours<N>::Neighbours(const Domain<N>& domain, Options options) : domain_(domain), options_(std::move(options)) {
  for (auto& search : searches_) search = make_search<N>(options_.search);
}

template <int N>
void Neighbours<N>::sort_by_space(Store<N>& store) {
  for (const Group group : all_groups) {
    const IndexRange r = store.range(group);
    // By id first: the counting sort keeps that order inside each cell.
    std::vector<std::uint32_t> by_id(r.size());
    std::iota(by_id.begin(), by_id.end(), 0U);
    const auto ids = store.ids().subspan(r.begin, r.size());
    const auto earlier = [&](auto a, auto b) { return ids[a] < ids[b]; };
    if (!std::is_sorted(by_id.begin(), by_id.end(), earlier)) std::sort(by_id.begin(), by_id.end(), earlier);
    std::vector<Vec<N>> x(r.size());
    const auto all_x = store.template get<field::x>();
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = all_x[r.begin + by_id[k]];

    CellGrid<N> grid;
    grid.build(x, list_radius_, domain_);
    std::vector<std::uint32_t> order(r.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = by_id[grid.order()[k]];
    if (!std::is_sorted(order.begin(), order.end())) store.permute(group, order);
  }
}

template <int N>
void Neighbours<N>::build(Store<N>& store, double support) {
  support_ = support;
  list_radius_ = support * (1 + options_.skin);
  for (auto& x : store.template get<field::x>()) x = domain_.wrapped(x);
  sort_by_space(store);
  std::ranges::copy(store.template get<field::x>(), store.template get<x_list>().begin());
  build_lists(store);
}

template <int N>
void Neighbours<N>::rebuild_from_list_positions(Store<N>& store, double support) {
  support_ = support;
  list_radius_ = support * (1 + options_.skin);
  build_lists(store);
}

template <int N>
void Neighbours<N>::build_lists(Store<N>& store) {
  const auto x = store.template get<x_list>();
  for (const Group group : all_groups) {
    const IndexRange r = store.range(group);
    searches_[static_cast<int>(group)]->build(x.subspan(r.begin, r.size()), list_radius_, domain_);
  }
  if (!options_.store_lists) return;
  for (const Group target : all_groups)
    for (const Group source : all_groups) {
      const IndexRange targets = store.range(target), sources = store.range(source);
      if (target == Group::wall && source == Group::wall) continue;  // walls do not act on walls
      lists_[static_cast<int>(target)][static_cast<int>(source)].fill(
          targets.size(), sources.begin, [&](std::size_t t, auto& found) {
            searches_[static_cast<int>(source)]->find(x[targets.begin + t], list_radius_, found);
          });
    }
}

template <int N>
bool Neighbours<N>::stale(const Store<N>& store, double support) const {
  const auto x = store.template get<field::x>();
  const auto x_old = store.template get<x_list>();
  const double allowed = 0.5 * (list_radius_ - support);
  if (list_radius_ <= 0 || allowed < 0) return true;
  bool moved = false;
#pragma omp parallel for reduction(|| : moved) schedule(static)
  for (std::size_t i = 0; i < x.size(); ++i)  // written so that a position that is not a number counts as moved
    moved = moved || !(norm_sq(domain_.nearest_image(x[i] - x_old[i])) <= sq(allowed));
  return moved;
}

template <int N>
std::span<const std::uint32_t> Neighbours<N>::of(Group target_group, std::size_t target, Group source_group,
                                                 const Store<N>& store, std::vector<std::uint32_t>& scratch) const {
  if (options_.store_lists) return list(target_group, source_group).of(target);
  const auto x = store.template get<x_list>();
  searches_[static_cast<int>(source_group)]->find(x[store.range(target_group).begin + target], list_radius_, scratch);
  for (auto& j : scratch) j += static_cast<std::uint32_t>(store.range(source_group).begin);
  return scratch;
}

template <int N>
void Neighbours<N>::near_point(const Vec<N>& x, Group group, const Store<N>& store,
                               std::vector<std::uint32_t>& found) const {
  // A particle within the support now was within support + skin/2 when the lists were built.
  searches_[static_cast<int>(group)]->find(x, list_radius_, found);
  for (auto& j : found) j += static_cast<std::uint32_t>(store.range(group).begin);
}

template <int N>
std::size_t Neighbours<N>::bytes() const {
  std::size_t total = 0;
  for (const auto& search : searches_) total += search ? search->bytes() : 0;
  for (const auto& row : lists_)
    for (const auto& list : row) total += list.bytes();
  return total;
}

template class Neighbours<1>;
template class Neighbours<2>;
template class Neighbours<3>;

}  // namespace undine
