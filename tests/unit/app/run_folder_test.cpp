#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "undine/app/run/folder.hpp"

namespace undine {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// By sorting, as the definition says.
FluidRange by_sorting(std::vector<double> values, const std::vector<char>& walls) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!walls[i] && std::isfinite(values[i])) kept.push_back(values[i]);
  std::ranges::sort(kept);
  const std::size_t last = kept.size() - 1, lower = last / 100;
  return {kept.front(), kept.back(), kept[lower], kept[last - lower]};
}

void expect_same(const std::vector<double>& values, const std::vector<char>& walls) {
  const FluidRange got = fluid_range(values, walls), want = by_sorting(values, walls);
  EXPECT_EQ(got.low, want.low);
  EXPECT_EQ(got.high, want.high);
  EXPECT_EQ(got.inner_low, want.inner_low);
  EXPECT_EQ(got.inner_high, want.inner_high);
}

TEST(FluidRange, is_what_sorting_gives) {
  std::mt19937 random(7);
  for (const std::size_t count : {1, 2, 99, 101, 202, 30'000}) {
    std::vector<char> walls(count, 0);
    std::vector<double> even(count), skewed(count), few(count), wild(count);
    for (std::size_t i = 0; i < count; ++i) {
      even[i] = std::uniform_real_distribution<double>(-3, 5)(random);
      skewed[i] = std::exp(40 * even[i]);  // nearly all in one bin
      few[i] = std::floor(even[i]);
      wild[i] = i % 7 == 0 ? std::nan("") : i % 11 == 0 ? infinity : even[i];
      walls[i] = i > 0 && i % 3 == 0;
    }
    if (count > 1) wild[1] = 1e38;
    expect_same(even, walls);
    expect_same(skewed, walls);
    expect_same(few, walls);
    if (count > 1) expect_same(wild, walls);
    expect_same(std::vector<double>(count, -2.5), walls);
  }
  std::vector<double> huge{-1.7e308, 1.7e308, 3, 4};  // their difference is no number
  expect_same(huge, std::vector<char>(4, 0));
  expect_same({1, std::nextafter(1.0, 2.0), 1}, {0, 0, 0});
}

TEST(FluidRange, of_nothing_is_the_wrong_way_round) {
  const FluidRange range = fluid_range({1, std::nan("")}, {1, 0});
  EXPECT_GT(range.low, range.high);
  EXPECT_GT(range.inner_low, range.inner_high);
}

}  // namespace
}  // namespace undine
