#include "undine/engine/candidates.hpp"

#include <bit>

#include <gtest/gtest.h>

#include "undine/backend/instructions.hpp"
#include "undine/core/aligned.hpp"
#include "unit/engine/crowd.hpp"

namespace undine {
namespace {

using test::Random;

template <int width>
void write_every_mask() {
  Random random(width);
  for (std::uint32_t k = 0; k < 5000; ++k) {
    const auto bits = static_cast<std::uint32_t>(width > 8 ? random.bits() : k) & ((2U << (width - 1)) - 1);
    const auto first = static_cast<std::uint32_t>(random.bits() >> 40);
    std::uint32_t to[width + 1];
    std::fill(std::begin(to), std::end(to), 77U);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t bit = 0; bit < width; ++bit)
      if (bits >> bit & 1) expected.push_back(first + bit);
    const auto count = static_cast<std::size_t>(write_bits<width>(to, first, bits));
    ASSERT_EQ(std::vector<std::uint32_t>(to, to + count), expected) << "bits " << bits;
    ASSERT_EQ(to[width], 77U) << "wrote too far";
  }
}

/// 16-bit halves of a code word.
std::int16_t low(std::int32_t word) { return static_cast<std::int16_t>(word); }
std::int16_t high(std::int32_t word) { return static_cast<std::int16_t>(word >> 16); }

/// Numbers whose differences are small, mostly, so that about half of all pairs pass.
std::int32_t random_word(Random& random) {
  const auto half = [&] { return static_cast<std::uint16_t>(random.bits() % 12000 - 6000); };
  return std::bit_cast<std::int32_t>(std::uint32_t{half()} << 16 | half());
}

/// The test as it is meant, number by number.
template <int N>
bool passes(const PairTest<N>& test, const CodeWords<N>& candidate, const CodeWords<N>& target, std::int32_t limit) {
  std::int64_t sum = 0;
  for (int k = 0; k < N; ++k) {
    const auto half = [&](const CodeWords<N>& words) {
      return std::int64_t{k % 2 ? high(words[k / 2]) : low(words[k / 2])};
    };
    std::int64_t d = std::abs(half(candidate) - half(target));
    if (test.short_period) d = std::min(d, std::abs(static_cast<std::uint16_t>(half(test.periods)) - d));
    sum += d * d;
  }
  return sum < limit;
}

/// Criterion: for runs of any length and place, with and without images, short periods and limits of their own, exactly
/// the candidates that pass by the plain test, for every instruction set that this machine has.
template <int N>
void prune_as_meant(InstructionSet set) {
  const auto prune = with_instructions(set, []<class Tag>() { return prune_table<Tag>().template in<N>(); });
  Random random(static_cast<std::uint64_t>(N));
  constexpr std::size_t particles = 4000, most_targets = 5;
  AlignedVector<std::int32_t> codes[code_words(N)];
  PairTest<N> test{};
  for (int w = 0; w < code_words(N); ++w) {
    for (std::size_t i = 0; i < particles; ++i)
      codes[w].push_back(random_word(random) & (N % 2 && w == N / 2 ? 0xffff : -1));
    test.codes[w] = codes[w].data();
  }
  AlignedVector<std::int32_t> limits;
  for (std::size_t i = 0; i < particles; ++i) limits.push_back(static_cast<std::int32_t>(random.bits() % 100000000));
  for (int trial = 0; trial < 300; ++trial) {
    const bool own = trial % 4 == 3;
    test.limits = own ? limits.data() : nullptr;
    test.limit = static_cast<std::int32_t>(random.bits() % 100000000);
    test.short_period = trial % 3 == 2;
    for (int k = 0; k < 2 * code_words(N); ++k) {
      const std::uint32_t period = k < N && k % 2 == trial % 2 ? 13000 : 0xffff;
      if (k % 2 == 0) test.periods[k / 2] = 0;
      test.periods[k / 2] |= static_cast<std::int32_t>(period << (k % 2 * 16));
    }
    std::vector<Candidates<N>> runs;
    CodeWords<N> image;
    for (std::uint32_t at = 0; at + 700 < particles && runs.size() < random.bits() % 20;) {
      if (trial % 3 == 1 && random.bits() % 4 == 0)
        for (int w = 0; w < code_words(N); ++w) image[w] = random_word(random) & (N % 2 && w == N / 2 ? 0xffff : -1);
      const std::uint32_t begin = at + static_cast<std::uint32_t>(random.bits() % 40);
      at = begin + 1 + static_cast<std::uint32_t>(random.bits() % (trial % 10 == 0 ? 3000 : 70));
      at = std::min<std::uint32_t>(at, particles);
      runs.push_back({begin, at, image});
    }
    Targets<N> targets;
    const std::size_t first = random.bits() % (particles - most_targets);
    for (int w = 0; w < code_words(N); ++w) targets.codes[w] = codes[w].data() + first;
    targets.limits = own ? limits.data() + first : nullptr;
    targets.count = 1 + random.bits() % most_targets;
    std::vector<std::uint32_t> expected, expected_ends;
    for (std::size_t t = 0; t < targets.count; ++t) {
      for (const auto& run : runs)
        for (std::uint32_t j = run.begin; j < run.end; ++j) {
          CodeWords<N> candidate, target;
          for (int w = 0; w < code_words(N); ++w) {
            candidate[w] = codes[w][j];
            const auto half = [&](int shift) {
              const int number = (targets.codes[w][t] >> shift) - (run.image[w] >> shift);
              return static_cast<std::uint32_t>(static_cast<std::uint16_t>(number)) << shift;
            };
            target[w] = static_cast<std::int32_t>(half(0) | half(16));
          }
          if (passes(test, candidate, target, own ? std::max(limits[first + t], limits[j]) : test.limit))
            expected.push_back(j);
        }
      expected_ends.push_back(static_cast<std::uint32_t>(expected.size()));
    }
    std::vector<std::uint32_t> found(targets.count * particles + PairTest<N>::padding), ends(targets.count);
    prune(test, targets, runs.data(), runs.size(), found.data(), ends.data());
    ASSERT_EQ(ends, expected_ends);
    found.resize(ends.back());
    ASSERT_EQ(found, expected);
  }
}

}  // namespace

TEST(Candidates, BitsAreWrittenAsNumbers) {
  write_every_mask<1>();
  write_every_mask<4>();
  write_every_mask<8>();
  write_every_mask<16>();
}

TEST(Candidates, ThoseThatPassArePicked) {
  for (const auto set : {InstructionSet::basic, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!can_run(set)) continue;
    SCOPED_TRACE(instruction_set_names[static_cast<std::size_t>(set)]);
    prune_as_meant<1>(set);
    prune_as_meant<2>(set);
    prune_as_meant<3>(set);
  }
}

}  // namespace undine
