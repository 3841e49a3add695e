#pragma once
// How lists find what goes onto them; included by neighbours.cpp alone.
#include <algorithm>
#include <array>

#include "undine/engine/neighbours.hpp"

namespace undine {

/// The one place that says which instruction set prunes.
template <int N>
Prune<N> pruning(InstructionSet instructions) {
  return with_instructions(instructions, []<class Tag>() { return prune_table<Tag>().template in<N>(); });
}

/// Finds the sources of targets by the cells that both lie in. Targets of one cell, which mostly follow each other,
/// share the candidates.
template <int N>
class Neighbours<N>::CellFinder {
 public:
  CellFinder(const Neighbours& all, Group target, Group source, const Store<N>& store,
             std::vector<Candidates<N>> work = {})
      : all_(all),
        targets_of_(all.parts_[static_cast<int>(target)]),
        sources_(all.parts_[static_cast<int>(source)]),
        x_(store.template get<field::x_list>()),
        first_target_(store.range(target).begin),
        prune_(pruning<N>(all.options_.instructions)),
        runs_(std::move(work)) {}
  /// The work space back, for the next finder.
  std::vector<Candidates<N>> release() { return std::move(runs_); }

  std::size_t batch(std::size_t target, std::size_t last) {
    const std::size_t i = first_target_ + target, size = all_.class_of(i);
    collect(x_[i], size);
    at_ = x_[i];
    limit_ = all_.codes_.limit(i);
    for (int w = 0; w < code_words(N); ++w) targets_.codes[w] = all_.test_.codes[w] + i;
    if (all_.test_.limits) targets_.limits = all_.test_.limits + i;
    targets_.count = 1;
    if (all_.far_apart_) return 1;
    const std::size_t end = std::min(last, targets_of_[size].range.end - first_target_);
    while (target + targets_.count < end && targets_.count * candidates_ < largest_batch &&
           in_same_cells(x_[i + targets_.count]))
      ++targets_.count;
    return targets_.count;
  }
  /// One target that is no particle.
  void at(const Vec<N>& x) {
    collect(x, 0);
    at_ = x;
    limit_ = all_.codes_.limit();
    words_ = all_.codes_.words(x);
    for (int w = 0; w < code_words(N); ++w) targets_.codes[w] = &words_[w];
    targets_.limits = &limit_;
    targets_.count = 1;
  }
  std::size_t room() const { return targets_.count * candidates_ + PairTest<N>::padding; }
  void find(std::uint32_t* to, std::uint32_t* ends) const {
    if (!all_.far_apart_) return prune_(all_.test_, targets_, runs_.data(), runs_.size(), to, ends);
    const auto* const first = to;
    for (const auto& run : runs_)
      for (std::uint32_t j = run.begin; j < run.end; ++j)
        if (all_.codes_.near(at_, x_[j], std::max(limit_, all_.codes_.limit(j)))) *to++ = j;
    ends[0] = static_cast<std::uint32_t>(to - first);
  }

 private:
  static constexpr std::size_t largest_batch = 1 << 16;  ///< numbers

  /// The candidates of a target of some class: class by class, as the store has them.
  void collect(const Vec<N>& x, std::size_t size) {
    runs_.clear();
    candidates_ = 0;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      if (sources_[s].range.size() == 0) continue;
      cells_[s] = all_.classes_[s].frame.cell_of(x);
      collect_from(s, all_.classes_[s].reach[size]);
    }
  }
  void collect_from(std::size_t s, const Cell& reach) {
    const auto first = static_cast<std::uint32_t>(sources_[s].range.begin);
    sources_[s].pencils.for_each_run_of(cells_[s], reach,
                                        [&](std::uint32_t begin, std::uint32_t end, const Cell& image, bool coarse) {
                                          if (coarse && !all_.far_apart_) {
                                            collect_one_by_one(s, reach, begin + first, end + first, image);
                                          } else {
                                            append(begin + first, end + first, all_.codes_.image_words(image));
                                          }
                                        });
  }
  /// Those of a run that are within reach along the first axis.
  void collect_one_by_one(std::size_t s, const Cell& reach, std::uint32_t begin, std::uint32_t end, Cell image) {
    const auto& frame = all_.classes_[s].frame;
    for (std::uint32_t j = begin; j < end; ++j) {
      int apart = frame.cell_of(x_[j])[0] - cells_[s][0];
      image[0] = 0;
      if (all_.domain_.periodic[0] && std::abs(apart) > reach[0]) {
        image[0] = apart > 0 ? -1 : 1;
        apart += image[0] * frame.cells(0);
      }
      if (std::abs(apart) <= reach[0]) append(j, j + 1, all_.codes_.image_words(image));
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
  bool in_same_cells(const Vec<N>& x) const {
    for (std::size_t s = 0; s < sources_.size(); ++s)
      if (sources_[s].range.size() > 0 && !(all_.classes_[s].frame.cell_of(x) == cells_[s])) return false;
    return true;
  }

  const Neighbours& all_;
  const std::vector<Part>& targets_of_;
  const std::vector<Part>& sources_;
  std::span<const Vec<N>> x_;
  std::size_t first_target_;
  Prune<N> prune_;
  Targets<N> targets_;
  CodeWords<N> words_;
  Vec<N> at_;
  std::int32_t limit_ = 0;
  std::array<Cell, most_classes> cells_;  ///< of the targets, in the frame of each class
  std::size_t candidates_ = 0;
  std::vector<Candidates<N>> runs_;
};

/// Asks the named search, and decides by the same test.
template <int N>
class Neighbours<N>::SearchFinder {
 public:
  SearchFinder(const Neighbours& all, Group target, Group source, const Store<N>& store)
      : all_(all),
        sources_(all.parts_[static_cast<int>(source)]),
        x_(store.template get<field::x_list>()),
        first_target_(store.range(target).begin) {}

  std::size_t batch(std::size_t target, std::size_t) {
    const std::size_t i = first_target_ + target;
    ask(x_[i], all_.class_of(i), all_.codes_.limit(i));
    return 1;
  }
  void at(const Vec<N>& x) { ask(x, 0, all_.codes_.limit()); }
  std::size_t room() const { return found_.size(); }
  void find(std::uint32_t* to, std::uint32_t* ends) const {
    std::ranges::copy(found_, to);
    ends[0] = static_cast<std::uint32_t>(found_.size());
  }

 private:
  void ask(const Vec<N>& x, std::size_t size, std::int32_t limit) {
    found_.clear();
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      const Part& part = sources_[s];
      if (part.range.size() == 0) continue;
      part.search->find(x, std::max(all_.classes_[s].search_radius, all_.classes_[size].search_radius), near_);
      for (const std::uint32_t k : near_) {
        const auto j = static_cast<std::uint32_t>(part.range.begin) + k;
        if (all_.codes_.near(x, x_[j], std::max(limit, all_.codes_.limit(j)))) found_.push_back(j);
      }
    }
  }

  const Neighbours& all_;
  const std::vector<Part>& sources_;
  std::span<const Vec<N>> x_;
  std::size_t first_target_;
  std::vector<std::uint32_t> near_, found_;
};

}  // namespace undine
