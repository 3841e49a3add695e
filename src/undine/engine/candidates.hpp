#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "undine/core/code_pack.hpp"
#include "undine/core/compress.hpp"
#include "undine/core/isa.hpp"

namespace undine {

/// Pairs of 16-bit numbers that the codes of one position take (engine/list_codes.hpp): x and y, then z and 0.
inline constexpr int code_words(int dimensions) { return (dimensions + 1) / 2; }
template <int N>
struct CodeWords {
  std::int32_t words[code_words(N)]{};

  std::int32_t& operator[](int w) { return words[w]; }
  std::int32_t operator[](int w) const { return words[w]; }
  bool operator==(const CodeWords& o) const {
    bool same = true;  // of so few words without a call, which std::array makes
    for (int w = 0; w < code_words(N); ++w) same = same && words[w] == o.words[w];
    return same;
  }
};

/// Code words that fill a cache line, and any vector register.
struct alignas(64) CodeLine {
  static constexpr std::size_t size = 16;
  std::int32_t words[size];
};

/// A run of particles, as store indices, among which neighbours of a target may be; `image` is added to their codes to
/// have them on the target's side of a period.
template <int N>
struct Candidates {
  std::uint32_t begin, end;
  CodeWords<N> image;
};

/// What decides whether two particles are on each other's lists.
template <int N>
struct PairTest {
  std::array<const std::int32_t*, code_words(N)> codes;  ///< one array of whole lines for each word
  std::int32_t limit;    ///< a pair passes when the sum of squared differences of codes is less
  bool short_period;     ///< whether some period is so short that a candidate may be near by either side
  CodeWords<N> periods;  ///< then the short ones; 2^16 - 1 along other axes
  /// Where particles have limits of their own, whole lines of them: the larger of a pair's counts.
  const std::int32_t* limits = nullptr;

  /// How many more numbers than it finds `prune` may overwrite.
  static constexpr std::size_t padding = CodeLine::size;
};

/// Targets that share their candidates: the codes of `count` of them, and their limits where they have their own.
template <int N>
struct Targets {
  std::array<const std::int32_t*, code_words(N)> codes;
  std::size_t count;
  const std::int32_t* limits = nullptr;
};

/// Runs cut to aligned registers: how long each run is would be mispredicted for each target, and loads across cache
/// lines cost twice.
template <int N>
class CandidateBlocks {
 public:
  struct Block {
    std::uint32_t first, bits;
  };

  CandidateBlocks(const Candidates<N>* runs, std::size_t count) : runs_(runs), end_(runs + count) { restart(); }

  void restart() {
    run_ = runs_;
    if (run_ != end_) next_ = run_->begin;
    more();
  }
  /// Goes on to the next blocks, which all have the same image.
  void more() {
    constexpr std::uint32_t lanes = CodePack::lanes, all = (2U << (lanes - 1)) - 1;
    count_ = 0;
    image_ = run_;
    while (run_ != end_ && count_ < most) {
      const std::uint32_t first = next_ / lanes * lanes, left = run_->end - first;
      blocks_[count_++] = {first, all << (next_ - first) & (left < lanes ? (1U << left) - 1 : all)};
      next_ = first + lanes;
      if (next_ < run_->end) continue;
      if (++run_ == end_) break;
      next_ = run_->begin;
      if (!(run_->image == image_->image)) break;
    }
  }
  bool at_end() const { return run_ == end_; }
  const Block* begin() const { return blocks_; }
  const Block* end() const { return blocks_ + count_; }
  const CodeWords<N>& image() const { return image_->image; }

 private:
  static constexpr std::size_t most = 128;
  const Candidates<N>*runs_, *end_, *run_, *image_;
  std::uint32_t next_ = 0;
  std::size_t count_ = 0;
  Block blocks_[most];
};

template <bool short_period, bool own_limits, int N>
void prune_with(const PairTest<N>& test, const Targets<N>& targets, const Candidates<N>* runs, std::size_t run_count,
                std::uint32_t* found, std::uint32_t* ends) {
  constexpr int words = code_words(N);
  const auto codes = test.codes;
  CodePack limit(test.limit);
  CandidateBlocks<N> blocks(runs, run_count);
  const bool all_at_once = blocks.at_end();
  std::uint32_t* to = found;
  for (std::size_t t = 0; t < targets.count; ++t) {
    if (!all_at_once) blocks.restart();
    if constexpr (own_limits) limit = CodePack(targets.limits[t]);
    for (; blocks.begin() != blocks.end(); blocks.more()) {
      CodePack at[words], period[words];
      for (int w = 0; w < words; ++w) {
        // Off by the image: a candidate and its image differ by whole periods from the target and its own.
        at[w] = CodePack(targets.codes[w][t]) - CodePack(blocks.image()[w]);
        period[w] = CodePack(test.periods[w]);
      }
      for (const auto& block : blocks) {
        CodePack distance_sq;
        for (int w = 0; w < words; ++w) {
          CodePack d = CodePack::load(codes[w] + block.first) - at[w];
          if constexpr (short_period) {
            const CodePack one_way = magnitude(d);
            d = lesser(one_way, period[w] - one_way);
          }
          distance_sq = w == 0 ? squares(d) : sum(distance_sq, squares(d));
        }
        CodePack of_pair = limit;
        if constexpr (own_limits) of_pair = larger(limit, CodePack::load(test.limits + block.first));
        to += write_bits<CodePack::lanes>(to, block.first, distance_sq.below(of_pair, block.bits));
      }
      if (blocks.at_end()) break;
    }
    ends[t] = static_cast<std::uint32_t>(to - found);
  }
}

/// Picks those candidates that pass the test against each target. `found` takes their indices, for each target
/// ascending as the runs are, target after target, and ends[t] is where those of target t end. `found` must have room
/// for all candidates of each target and PairTest::padding more. No run is empty.
template <int N>
void prune(const PairTest<N>& test, const Targets<N>& targets, const Candidates<N>* runs, std::size_t run_count,
           std::uint32_t* found, std::uint32_t* ends) {
  const auto chosen = test.limits ? (test.short_period ? prune_with<true, true, N> : prune_with<false, true, N>)
                                  : (test.short_period ? prune_with<true, false, N> : prune_with<false, false, N>);
  chosen(test, targets, runs, run_count, found, ends);
}

/// `prune` for one dimension, compiled for one instruction set.
template <int N>
using Prune = void (*)(const PairTest<N>&, const Targets<N>&, const Candidates<N>*, std::size_t, std::uint32_t*,
                       std::uint32_t*);

struct PruneTable {
  Prune<1> in_1d;
  Prune<2> in_2d;
  Prune<3> in_3d;

  template <int N>
  Prune<N> in() const {
    if constexpr (N == 1) return in_1d;
    if constexpr (N == 2) return in_2d;
    if constexpr (N == 3) return in_3d;
  }
};

/// The table of the instruction set `Tag` (core/isa.hpp).
template <class Tag>
const PruneTable& prune_table();

}  // namespace undine
