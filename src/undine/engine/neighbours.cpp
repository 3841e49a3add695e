#include "undine/engine/neighbours.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <unistd.h>

#include "undine/core/stopwatch.hpp"

namespace undine {
namespace {

using field::x_list;

/// The one place that says which instruction set prunes.
template <int N>
Prune<N> pruning(InstructionSet instructions) {
  return with_instructions(instructions, []<class Tag>() { return prune_table<Tag>().template in<N>(); });
}

double physical_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Walls do not act on walls.
bool interact(Group target, Group source) { return target != Group::wall || source != Group::wall; }

}  // namespace

/// Finds the sources of targets by the cells that both lie in. Targets of one cell, which mostly follow each other,
/// share the candidates.
template <int N>
class Neighbours<N>::CellFinder {
 public:
  CellFinder(const Neighbours& all, Group target, Group source, const Store<N>& store,
             std::vector<Candidates<N>> work = {})
      : all_(all),
        pencils_(all.pencils_[static_cast<int>(source)]),
        x_(store.template get<x_list>()),
        first_target_(store.range(target).begin),
        first_source_(static_cast<std::uint32_t>(store.range(source).begin)),
        prune_(pruning<N>(all.options_.instructions)),
        runs_(std::move(work)) {}
  /// The work space back, for the next finder.
  std::vector<Candidates<N>> release() { return std::move(runs_); }

  std::size_t batch(std::size_t target, std::size_t last) {
    const std::size_t i = first_target_ + target;
    const auto cell = all_.frame_.cell_of(x_[i]);
    collect(cell);
    at_ = x_[i];
    for (int w = 0; w < code_words(N); ++w) targets_.codes[w] = all_.test_.codes[w] + i;
    targets_.count = 1;
    if (all_.far_apart_) return 1;
    while (target + targets_.count < last && targets_.count * candidates_ < largest_batch &&
           all_.frame_.cell_of(x_[i + targets_.count]) == cell)
      ++targets_.count;
    return targets_.count;
  }
  /// One target that is no particle.
  void at(const Vec<N>& x) {
    collect(all_.frame_.cell_of(x));
    at_ = x;
    words_ = all_.codes_.words(x);
    for (int w = 0; w < code_words(N); ++w) targets_.codes[w] = &words_[w];
    targets_.count = 1;
  }
  std::size_t room() const { return targets_.count * candidates_ + PairTest<N>::padding; }
  void find(std::uint32_t* to, std::uint32_t* ends) const {
    if (!all_.far_apart_) return prune_(all_.test_, targets_, runs_.data(), runs_.size(), to, ends);
    const auto* const first = to;
    for (const auto& run : runs_)
      for (std::uint32_t j = run.begin; j < run.end; ++j)
        if (all_.codes_.near(at_, x_[j])) *to++ = j;
    ends[0] = static_cast<std::uint32_t>(to - first);
  }

 private:
  using Cell = typename CellFrame<N>::Cell;
  static constexpr std::size_t largest_batch = 1 << 16;  ///< numbers

  void collect(const Cell& cell) {
    runs_.clear();
    candidates_ = 0;
    pencils_.for_each_run_of(cell, all_.reach_,
                             [&](std::uint32_t begin, std::uint32_t end, const Cell& image, bool coarse) {
                               if (coarse && !all_.far_apart_) {
                                 collect_one_by_one(cell, begin + first_source_, end + first_source_, image);
                               } else {
                                 append(begin + first_source_, end + first_source_, all_.codes_.image_words(image));
                               }
                             });
  }
  /// Those of a run that are within reach along the first axis.
  void collect_one_by_one(const Cell& cell, std::uint32_t begin, std::uint32_t end, Cell image) {
    for (std::uint32_t j = begin; j < end; ++j) {
      int apart = all_.frame_.cell_of(x_[j])[0] - cell[0];
      image[0] = 0;
      if (all_.domain_.periodic[0] && std::abs(apart) > all_.reach_[0]) {
        image[0] = apart > 0 ? -1 : 1;
        apart += image[0] * all_.frame_.cells(0);
      }
      if (std::abs(apart) <= all_.reach_[0]) append(j, j + 1, all_.codes_.image_words(image));
    }
  }
  void append(std::uint32_t begin, std::uint32_t end, const CodeWords<N>& image) {
    candidates_ += end - begin;
    if (!runs_.empty() && runs_.back().end == begin && runs_.back().image == image) {
      runs_.back().end = end;
    } else {
      runs_.push_back({begin, end, image});
    }
  }

  const Neighbours& all_;
  const Pencils<N>& pencils_;
  std::span<const Vec<N>> x_;
  std::size_t first_target_;
  std::uint32_t first_source_;
  Prune<N> prune_;
  Targets<N> targets_;
  CodeWords<N> words_;
  Vec<N> at_;
  std::size_t candidates_ = 0;
  std::vector<Candidates<N>> runs_;
};

/// Asks the named search, and decides by the same test.
template <int N>
class Neighbours<N>::SearchFinder {
 public:
  SearchFinder(const Neighbours& all, Group target, Group source, const Store<N>& store)
      : all_(all),
        search_(*all.searches_[static_cast<int>(source)]),
        x_(store.template get<x_list>()),
        first_target_(store.range(target).begin),
        first_source_(static_cast<std::uint32_t>(store.range(source).begin)) {}

  std::size_t batch(std::size_t target, std::size_t) {
    at(x_[first_target_ + target]);
    return 1;
  }
  void at(const Vec<N>& x) {
    search_.find(x, all_.codes_.search_radius(), found_);
    for (auto& j : found_) j += first_source_;
    std::erase_if(found_, [&](auto j) { return !all_.codes_.near(x, x_[j]); });
  }
  std::size_t room() const { return found_.size(); }
  void find(std::uint32_t* to, std::uint32_t* ends) const {
    std::ranges::copy(found_, to);
    ends[0] = static_cast<std::uint32_t>(found_.size());
  }

 private:
  const Neighbours& all_;
  const NeighbourSearch<N>& search_;
  std::span<const Vec<N>> x_;
  std::size_t first_target_;
  std::uint32_t first_source_;
  std::vector<std::uint32_t> found_;
};

template <int N>
template <class F>
decltype(auto) Neighbours<N>::with_finder(Group target, Group source, const Store<N>& store, F&& f) const {
  if (ask_search_) return f([&, target, source] { return SearchFinder(*this, target, source, store); });
  return f([&, target, source] { return CellFinder(*this, target, source, store); });
}

template <int N>
Neighbours<N>::Neighbours(const Domain<N>& domain, Options options) : domain_(domain), options_(std::move(options)) {
  for (auto& search : searches_) search = make_search<N>(options_.search);
}

template <int N>
void Neighbours<N>::start(double support, const Box<N>& box, std::size_t particles) {
  support_ = support;
  list_radius_ = support * (1 + options_.skin);
  codes_.choose_unit(box, list_radius_, domain_);
  frame_ = CellFrame<N>(box, particles, codes_.search_radius(), domain_);
  reach_ = frame_.reach(codes_.search_radius());
  far_apart_ = frame_.cells(0) > 1 << 29;
  for (int k = 1; k < N; ++k) far_apart_ = far_apart_ || frame_.width(k) > 1.6 * codes_.search_radius();
  ask_search_ = options_.lists == Lists::plain || options_.search != "cell_grid";
}

template <int N>
void Neighbours<N>::sort_by_space(Store<N>& store) {
  const Stopwatch watch(seconds_sort_);
  const auto x = store.template get<field::x>();
  const bool periodic = domain_.any_periodic();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < x.size(); ++i)
    if (periodic) x[i] = domain_.wrapped(x[i]);
  start(support_, box_around<N>(x), store.size());
  for (const Group group : all_groups) {
    const IndexRange r = store.range(group);
    auto& pencils = pencils_[static_cast<int>(group)];
    pencils.build(frame_, x.subspan(r.begin, r.size()), store.ids().subspan(r.begin, r.size()), store.workspace());
    if (!pencils.in_order()) store.permute(group, pencils.order());
  }
}

template <int N>
void Neighbours<N>::build(Store<N>& store, double support) {
  support_ = support;
  sort_by_space(store);
  const auto x = store.template get<field::x>();
  const auto x_old = store.template get<x_list>();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < x.size(); ++i) x_old[i] = x[i];
  build_lists(store);
}

template <int N>
void Neighbours<N>::rebuild_from_list_positions(Store<N>& store, double support) {
  const std::span<const Vec<N>> x = store.template get<x_list>();
  start(support, box_around(x), store.size());
  for (const Group group : all_groups) {
    const IndexRange r = store.range(group);
    auto& pencils = pencils_[static_cast<int>(group)];
    pencils.build(frame_, x.subspan(r.begin, r.size()), store.ids().subspan(r.begin, r.size()), store.workspace());
    // Written by a version that sorted otherwise: the cells do not fit the order, but any search does.
    ask_search_ = ask_search_ || !pencils.in_order();
  }
  build_lists(store);
}

template <int N>
void Neighbours<N>::build_lists(const Store<N>& store) {
  const Stopwatch watch(seconds_lists_);
  ++builds_;
  const auto x = store.template get<x_list>();
  codes_.encode(x);
  Vec<N, bool> either_side;
  for (int k = 0; k < N; ++k) either_side[k] = frame_.either_side(k, reach_[k]);
  test_ = codes_.test(either_side);
  if (ask_search_)
    for (const Group group : all_groups) {
      const IndexRange r = store.range(group);
      searches_[static_cast<int>(group)]->build(x.subspan(r.begin, r.size()), codes_.search_radius(), domain_);
    }
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
  if (list_radius_ <= 0 || allowed < 0) return true;
  bool moved = false;
#pragma omp parallel for reduction(|| : moved) schedule(static)
  for (std::size_t i = 0; i < x.size(); ++i)  // written so that a position that is not a number counts as moved
    moved = moved || !(norm_sq(domain_.nearest_image(x[i] - x_old[i])) <= sq(allowed));
  return moved;
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
  for (const auto& pencils : pencils_) targets += pencils.order().size();
  const std::size_t fluid = pencils_[static_cast<int>(Group::fluid)].order().size();
  return fmt::format("stored lists, {:.0f} neighbours, {:.0f} bytes per particle",
                     static_cast<double>(pair_count(Group::fluid, Group::fluid)) /
                         static_cast<double>(std::max<std::size_t>(fluid, 1)),
                     static_cast<double>(list_bytes()) / static_cast<double>(std::max<std::size_t>(targets, 1)));
}

template <int N>
std::size_t Neighbours<N>::bytes() const {
  std::size_t total = codes_.bytes();
  for (const auto& pencils : pencils_) total += pencils.bytes();
  if (ask_search_)
    for (const auto& search : searches_) total += search->bytes();
  return total + list_bytes();
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
