#include "undine/engine/neighbours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <unistd.h>

#include "undine/core/stopwatch.hpp"
#include "undine/engine/neighbour_finders.hpp"

namespace undine {
namespace {

using field::h_list;
using field::x_list;

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Walls do not act on walls.
bool interact(Group target, Group source) { return target != Group::wall || source != Group::wall; }

}  // namespace

template <int N>
template <class F>
decltype(auto) Neighbours<N>::with_finder(Group target, Group source, const Store<N>& store, F&& f) const {
  if (ask_search_) return f([&, target, source] { return SearchFinder(*this, target, source, store); });
  return f([&, target, source] { return CellFinder(*this, target, source, store); });
}

template <int N>
Neighbours<N>::Neighbours(const Domain<N>& domain, Options options) : domain_(domain), options_(std::move(options)) {
  for (auto& parts : parts_) {
    parts.resize(1);
    parts.front().search = make_search<N>(options_.search);
  }
}

/// What follows from supports and from the box around all particles; `own_supports` is empty where they have none.
template <int N>
void Neighbours<N>::start(double support, const Box<N>& box, std::span<const double> own_supports,
                          std::size_t particles) {
  support_ = support;
  list_radius_ = support * (1 + options_.skin);
  codes_.choose_unit(box, list_radius_, domain_);
  choose_classes(own_supports);
  ask_search_ = options_.lists == Lists::plain || options_.search != "cell_grid";
  far_apart_ = false;
  for (SizeClass& size : classes_) {
    size.frame = CellFrame<N>(box, particles, size.search_radius, domain_);
    size.reach.clear();
    for (const SizeClass& target : classes_)
      size.reach.push_back(size.frame.reach(std::max(size.search_radius, target.search_radius)));
    far_apart_ = far_apart_ || size.frame.cells(0) > 1 << 29;
    for (int k = 1; k < N; ++k) far_apart_ = far_apart_ || size.frame.width(k) > 1.6 * codes_.search_radius();
  }
  for (auto& parts : parts_) parts.resize(classes_.size());
}

/// Class k holds list radii from 2^(-k/2) of the largest down to 2^(-(k+1)/2) of it, the last class all below.
template <int N>
void Neighbours<N>::choose_classes(std::span<const double> own_supports) {
  radii_.resize(own_supports.size());
  class_of_.resize(own_supports.size());
  std::array<double, most_classes> nobody, widest;
  nobody.fill(-1);
  widest = nobody;
#pragma omp parallel
  {
    auto part = nobody;
#pragma omp for schedule(static) nowait
    for (std::size_t i = 0; i < own_supports.size(); ++i) {
      const double radius = own_supports[i] * (1 + options_.skin), ratio = list_radius_ / radius;
      // What is not a number is as wide as the widest.
      const int size = ratio >= 1 ? std::clamp(std::ilogb(ratio * ratio), 0, most_classes - 1) : 0;
      radii_[i] = radius;
      class_of_[i] = static_cast<std::uint8_t>(size);
      part[size] = std::max(part[size], radius);
    }
#pragma omp critical(undine_size_classes)
    for (int k = 0; k < most_classes; ++k) widest[k] = std::max(widest[k], part[k]);
  }
  std::size_t count = most_classes;
  while (count > 1 && widest[count - 1] < 0) --count;
  classes_.resize(count);
  classes_.front().search_radius = codes_.search_radius();
  for (std::size_t k = 1; k < count; ++k)
    classes_[k].search_radius = widest[k] < 0 ? classes_[k - 1].search_radius : codes_.search_radius(widest[k]);
}

template <int N>
void Neighbours<N>::sort_by_space(Store<N>& store) {
  const Stopwatch watch(seconds_sort_);
  const auto x = store.template get<field::x>();
  const bool periodic = domain_.any_periodic();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < x.size(); ++i)
    if (periodic) x[i] = domain_.wrapped(x[i]);
  const auto own = [&]() -> std::span<const double> {
    if (!options_.own_supports) return {};
    return store.template get<field::h>();
  };
  start(support_, box_around<N>(x), own(), store.size());
  for (const Group group : all_groups) sort_group(store, group);
  if (options_.own_supports) choose_classes(own());  // the same, in the order that particles have now
}

/// By class, then by cell, then by id.
template <int N>
void Neighbours<N>::sort_group(Store<N>& store, Group group) {
  const IndexRange r = store.range(group);
  const std::span<const Vec<N>> x = store.template get<field::x>();
  const std::span<const std::int64_t> ids = store.ids();
  auto& parts = parts_[static_cast<int>(group)];
  if (classes_.size() == 1) {
    Part& part = parts.front();
    part.range = r;
    part.pencils.build(classes_.front().frame, x.subspan(r.begin, r.size()), ids.subspan(r.begin, r.size()),
                       store.workspace());
    if (!part.pencils.in_order()) store.permute(group, part.pencils.order());
    return;
  }
  std::vector<std::uint32_t> order, members;
  std::vector<Vec<N>> places;
  std::vector<std::int64_t> names;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    members.clear();
    places.clear();
    names.clear();
    for (std::size_t i = r.begin; i < r.end; ++i) {
      if (class_of_[i] != k) continue;
      members.push_back(static_cast<std::uint32_t>(i - r.begin));
      places.push_back(x[i]);
      names.push_back(ids[i]);
    }
    parts[k].range = {r.begin + order.size(), r.begin + order.size() + members.size()};
    parts[k].pencils.build(classes_[k].frame, places, names, store.workspace());
    for (const std::uint32_t place : parts[k].pencils.order()) order.push_back(members[place]);
  }
  if (!std::ranges::is_sorted(order)) store.permute(group, order);
}

template <int N>
void Neighbours<N>::build(Store<N>& store, double support) {
  support_ = support;
  sort_by_space(store);
  const auto x = store.template get<field::x>();
  const auto x_old = store.template get<x_list>();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < x.size(); ++i) x_old[i] = x[i];
  if (options_.own_supports) std::ranges::copy(store.template get<field::h>(), store.template get<h_list>().begin());
  build_lists(store);
}

template <int N>
void Neighbours<N>::rebuild_from_list_positions(Store<N>& store, double support) {
  const std::span<const Vec<N>> x = store.template get<x_list>();
  start(support, box_around(x), options_.own_supports ? store.template get<h_list>() : std::span<double>{},
        store.size());
  bool in_order = true;
  for (const Group group : all_groups) in_order = take_order(store, group) && in_order;
  if (!in_order) {
    // Written by a version that sorted otherwise: the cells do not fit the order, but any search does.
    join_classes(store);
    ask_search_ = true;
  }
  build_lists(store);
}

/// Takes the particles as they lie; whether that is in order.
template <int N>
bool Neighbours<N>::take_order(Store<N>& store, Group group) {
  const IndexRange r = store.range(group);
  const std::span<const Vec<N>> x = store.template get<x_list>();
  const std::span<const std::int64_t> ids = store.ids();
  bool in_order = true;
  std::size_t at = r.begin;
  for (std::size_t k = 0; k < classes_.size(); ++k) {
    Part& part = parts_[static_cast<int>(group)][k];
    part.range.begin = at;
    while (at < r.end && class_of(at) == k) ++at;
    part.range.end = at;
    const std::size_t count = part.range.size();
    part.pencils.build(classes_[k].frame, x.subspan(part.range.begin, count), ids.subspan(part.range.begin, count),
                       store.workspace());
    in_order = in_order && part.pencils.in_order();
  }
  return in_order && at == r.end;
}

/// One class for all, as wide as the widest.
template <int N>
void Neighbours<N>::join_classes(const Store<N>& store) {
  classes_.resize(1);
  for (const Group group : all_groups) {
    auto& parts = parts_[static_cast<int>(group)];
    parts.resize(1);
    parts.front().range = store.range(group);
  }
}

template <int N>
void Neighbours<N>::build_lists(const Store<N>& store) {
  const Stopwatch watch(seconds_lists_);
  ++builds_;
  const auto x = store.template get<x_list>();
  codes_.encode(x);
  if (options_.own_supports) codes_.encode_radii(radii_);
  Vec<N, bool> either_side{};
  for (const SizeClass& size : classes_)
    for (const Cell& reach : size.reach)
      for (int k = 0; k < N; ++k) either_side[k] = either_side[k] || size.frame.either_side(k, reach[k]);
  test_ = codes_.test(either_side);
  if (ask_search_) build_searches(x);
  stored_ = options_.lists == Lists::stored;
  if (options_.lists == Lists::automatic) {
    list_bytes_needed_ = estimated_list_bytes(store);
    stored_ = list_bytes_needed_ <= list_bytes_allowed();
  }
  for (const Group target : all_groups)
    for (const Group source : all_groups) {
      auto& filled = lists_[static_cast<int>(target)][static_cast<int>(source)];
      if (!stored_) filled.clear();
      if (!stored_ || !interact(target, source)) continue;
      with_finder(target, source, store,
                  [&](auto make_finder) { filled.fill(store.range(target).size(), make_finder); });
    }
}

template <int N>
void Neighbours<N>::build_searches(std::span<const Vec<N>> x) {
  for (auto& parts : parts_)
    for (Part& part : parts) {
      if (!part.search) part.search = make_search<N>(options_.search);
      part.search->build(x.subspan(part.range.begin, part.range.size()), codes_.search_radius(), domain_);
    }
}

template <int N>
double Neighbours<N>::list_bytes_allowed() const {
  return options_.list_memory > 0 ? options_.list_memory : 0.25 * physical_memory();
}

template <int N>
double Neighbours<N>::estimated_list_bytes(const Store<N>& store) const {
  constexpr std::size_t largest_sample = 256;
  double total = 0;
  for (const Group target : all_groups)
    for (const Group source : all_groups) {
      const std::size_t targets = store.range(target).size(), sample = std::min(targets, largest_sample);
      if (sample == 0 || !interact(target, source)) continue;
      std::size_t found = 0;
      Scratch scratch;
      for (std::size_t k = 0; k < sample; ++k)
        found += find(target, k * targets / sample, source, store, scratch).size();
      const double mean = static_cast<double>(found) / static_cast<double>(sample);
      total += static_cast<double>(targets) * (1.05 * mean + 1) * sizeof(std::uint32_t);
    }
  return total;
}

template <int N>
bool Neighbours<N>::stale(const Store<N>& store, double support) const {
  const auto x = store.template get<field::x>();
  const auto x_old = store.template get<x_list>();
  const double allowed = 0.5 * (list_radius_ - support);
  if (list_radius_ <= 0) return true;
  if (options_.own_supports) return own_stale(store);
  if (allowed < 0) return true;
  bool moved = false;
#pragma omp parallel for reduction(|| : moved) schedule(static)
  for (std::size_t i = 0; i < x.size(); ++i)  // written so that a position that is not a number counts as moved
    moved = moved || !(norm_sq(domain_.nearest_image(x[i] - x_old[i])) <= sq(allowed));
  return moved;
}

/// Let mu be the largest |dx_a|/H_a and gamma the largest growth dH_a/H_a, H_a being those of the build, and H_a >=
/// H_b. A pair that is not on the lists had r >= (1 + skin) H_a. It now has r >= (1 + skin - 2 mu) H_a, which reaches
/// beyond (1 + gamma) H_a, hence beyond both supports, as long as 2 mu + gamma <= skin.
template <int N>
bool Neighbours<N>::own_stale(const Store<N>& store) const {
  const auto x = store.template get<field::x>(), x_old = store.template get<x_list>();
  const auto h = store.template get<field::h>(), h_old = store.template get<h_list>();
  double moved = 0, grown = 0;
  bool finite = true;
#pragma omp parallel for reduction(max : moved, grown) reduction(&& : finite) schedule(static)
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double move_sq = norm_sq(domain_.nearest_image(x[i] - x_old[i])) / sq(h_old[i]);
    const double growth = h[i] / h_old[i] - 1;
    moved = std::max(moved, move_sq);
    grown = std::max(grown, growth);
    finite = finite && std::isfinite(move_sq) && std::isfinite(growth);
  }
  return !finite || !(2 * std::sqrt(moved) + grown <= options_.skin);
}

template <int N>
std::span<const std::uint32_t> Neighbours<N>::find(Group target_group, std::size_t target, Group source_group,
                                                   const Store<N>& store, Scratch& scratch) const {
  if (!interact(target_group, source_group)) return {};
  if (scratch.owner_ != this || scratch.build_ != builds_ || scratch.target_group_ != target_group) {
    scratch.owner_ = this;
    scratch.build_ = builds_;
    scratch.target_group_ = target_group;
    for (auto& batch : scratch.batches_) batch.last = 0;
  }
  auto& batch = scratch.batches_[static_cast<int>(source_group)];
  if (target < batch.first || target >= batch.last) {
    const auto refill = [&](auto& finder) {
      const std::size_t count = finder.batch(target, store.range(target_group).size());
      batch.first = target;
      batch.last = target + count;
      if (batch.found.size() < finder.room() + list_padding) batch.found.resize(finder.room() + list_padding);
      batch.ends.resize(count + 1);
      batch.ends[0] = 0;
      finder.find(batch.found.data(), batch.ends.data() + 1);
    };
    if (ask_search_) {
      SearchFinder finder(*this, target_group, source_group, store);
      refill(finder);
    } else {
      CellFinder finder(*this, target_group, source_group, store, std::move(scratch.runs_));
      refill(finder);
      scratch.runs_ = finder.release();
    }
  }
  const std::uint32_t* ends = batch.ends.data() + (target - batch.first);
  return {batch.found.data() + ends[0], ends[1] - ends[0]};
}

template <int N>
std::span<const std::uint32_t> Neighbours<N>::of(Group target_group, std::size_t target, Group source_group,
                                                 const Store<N>& store, std::vector<std::uint32_t>& scratch) const {
  Scratch work;
  const auto found = of(target_group, target, source_group, store, work);
  scratch.assign(found.begin(), found.end());
  return scratch;
}

template <int N>
void Neighbours<N>::near_point(const Vec<N>& x, Group group, const Store<N>& store,
                               std::vector<std::uint32_t>& found) const {
  // A particle within the support now was within support + skin/2 when the lists were built.
  with_finder(group, group, store, [&](auto make_finder) {
    auto finder = make_finder();
    finder.at(domain_.wrapped(x));
    found.resize(finder.room());
    std::uint32_t count;
    finder.find(found.data(), &count);
    found.resize(count);
  });
}

template <int N>
std::string Neighbours<N>::describe() const {
  constexpr double GB = 1e9;
  if (options_.lists == Lists::plain) return fmt::format("plain: each particle asks {}", options_.search);
  if (options_.lists == Lists::free) return "list-free: asked for";
  if (!stored_)
    return fmt::format("list-free: lists would need {:.1f} GB of {:.1f} GB allowed", list_bytes_needed_ / GB,
                       list_bytes_allowed() / GB);
  std::size_t targets = 0;
  const auto count = [&](Group group) {
    std::size_t n = 0;
    for (const Part& part : parts_[static_cast<int>(group)]) n += part.range.size();
    return n;
  };
  for (const Group group : all_groups) targets += count(group);
  const std::size_t fluid = count(Group::fluid);
  return fmt::format("stored lists, {:.0f} neighbours, {:.0f} bytes per particle",
                     static_cast<double>(pair_count(Group::fluid, Group::fluid)) /
                         static_cast<double>(std::max<std::size_t>(fluid, 1)),
                     static_cast<double>(list_bytes()) / static_cast<double>(std::max<std::size_t>(targets, 1)));
}

template <int N>
std::size_t Neighbours<N>::bytes() const {
  std::size_t total = codes_.bytes();
  for (const auto& parts : parts_)
    for (const Part& part : parts) total += part.pencils.bytes() + (ask_search_ ? part.search->bytes() : 0);
  return total + radii_.capacity() * sizeof(double) + class_of_.capacity() + list_bytes();
}

template <int N>
std::size_t Neighbours<N>::list_bytes() const {
  std::size_t total = 0;
  for (const auto& row : lists_)
    for (const auto& list : row) total += list.bytes();
  return total;
}

template class Neighbours<1>;
template class Neighbours<2>;
template class Neighbours<3>;

}  // namespace undine
