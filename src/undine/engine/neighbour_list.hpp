#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace undine {

/// Numbers behind the end of every list that may be read too: any indices of particles.
inline constexpr std::size_t list_padding = 16;

/// For each target of a group, the indices (in the store) of the particles of a source group within the list radius,
/// ascending.
class NeighbourList {
 public:
  /// Targets that a thread takes at once; small enough to balance splashes, large enough to cost nothing.
  static constexpr std::size_t targets_per_part = 512;

  /// Fills the list in parallel. Each thread gets a finder of its own from `make_finder()`. `finder.batch(t, last)`
  /// says how many targets from t on, before last, are found at once; then `finder.room()` how many numbers that may
  /// overwrite at most, and `finder.find(to, ends)` writes the sources of each, and where they end.
  /// Memory is kept from one build to the next.
  template <class MakeFinder>
  void fill(std::size_t targets, MakeFinder&& make_finder) {
    parts_.resize((targets + targets_per_part - 1) / targets_per_part);
    blocks_in_use_ = 0;
#pragma omp parallel
    {
      auto finder = make_finder();
      Room room;
#pragma omp for schedule(dynamic, 1)
      for (std::size_t p = 0; p < parts_.size(); ++p)
        fill_part(parts_[p], p * targets_per_part, std::min(targets, (p + 1) * targets_per_part), finder, room);
    }
  }
  void clear() {
    parts_ = std::vector<Part>();
    blocks_ = std::vector<Block>();
  }

  std::span<const std::uint32_t> of(std::size_t target) const {
    if (parts_.empty()) return {};
    const Part& part = parts_[target / targets_per_part];
    const std::size_t t = target % targets_per_part;
    return {part.indices + part.starts[t], part.starts[t + 1] - part.starts[t]};
  }
  std::size_t pairs() const {
    std::size_t total = 0;
    for (const Part& part : parts_) total += part.starts.back();
    return total;
  }
  /// Memory that was ever written to.
  std::size_t bytes() const {
    std::size_t numbers = 0;
    for (const Part& part : parts_) numbers += part.starts.capacity();
    for (const Block& block : blocks_) numbers += block.used;
    return numbers * sizeof(std::uint32_t);
  }

 private:
  struct Part {
    const std::uint32_t* indices = nullptr;
    std::vector<std::uint32_t> starts;
  };
  /// Memory for some parts: fresh memory costs more than finding what goes there, so parts own none.
  struct Block {
    std::unique_ptr<std::uint32_t[]> numbers;
    std::size_t size = 0, used = 0;
  };
  /// What is left of the block that a thread fills.
  struct Room {
    std::uint32_t *at = nullptr, *end = nullptr;
    std::size_t block = 0;
  };
  static constexpr std::size_t block_size = 1 << 20;

  template <class Finder>
  void fill_part(Part& part, std::size_t first, std::size_t last, Finder& finder, Room& room) {
    part.starts.resize(last - first + 1);
    part.starts[0] = 0;
    std::size_t used = 0;
    for (std::size_t t = first, count = 0; t < last; t += count) {
      count = finder.batch(t, last);
      const std::size_t needed = used + finder.room() + list_padding;
      if (needed > static_cast<std::size_t>(room.end - room.at)) room = next_block(room.at, used, needed);
      std::uint32_t* ends = part.starts.data() + (t - first) + 1;
      finder.find(room.at + used, ends);
      for (std::size_t k = 0; k < count; ++k) ends[k] += static_cast<std::uint32_t>(used);
      used = ends[count - 1];
    }
    part.indices = room.at;
    if (room.at == nullptr) return;
    std::fill_n(room.at + used, list_padding, 0U);  // until the next part begins there
    room.at += used;
    note_use(room);
  }

  /// A block with room for `needed` numbers, which begins with the `used` ones at `from`.
  Room next_block(const std::uint32_t* from, std::size_t used, std::size_t needed) {
    const std::lock_guard lock(*mutex_);
    const std::size_t index = blocks_in_use_++;
    if (index == blocks_.size()) blocks_.emplace_back();
    Block& block = blocks_[index];
    if (block.size < needed) {
      block.size = std::max(block_size, needed);
      block.numbers = std::make_unique_for_overwrite<std::uint32_t[]>(block.size);
      block.used = 0;
    }
    std::copy_n(from, used, block.numbers.get());
    return {block.numbers.get(), block.numbers.get() + block.size, index};
  }
  void note_use(const Room& room) {
    const std::lock_guard lock(*mutex_);
    Block& block = blocks_[room.block];
    block.used = std::max(block.used, static_cast<std::size_t>(room.at - block.numbers.get()));
  }

  std::vector<Part> parts_;
  std::vector<Block> blocks_;
  std::size_t blocks_in_use_ = 0;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();  ///< of the two above; lists can be moved
};

}  // namespace undine
