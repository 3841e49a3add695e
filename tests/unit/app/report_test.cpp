#include "undine/app/report/report.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <zlib.h>

#include "undine/app/report/blocks.hpp"
#include "undine/app/report/particles.hpp"
#include "undine/io/atomic_file.hpp"

namespace undine {
namespace {

std::vector<unsigned char> from_base64(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<unsigned char> bytes;
  unsigned word = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<unsigned>(digits.find(c));
    if ((bits += 6) >= 8) bytes.push_back(static_cast<unsigned char>(word >> (bits -= 8) & 255));
  }
  return bytes;
}

template <class T>
std::vector<T> unpacked(const std::string& text, std::size_t count) {
  const auto packed = from_base64(text);
  uLongf size = count * sizeof(T);
  std::vector<unsigned char> bytes(size);
  EXPECT_EQ(uncompress(bytes.data(), &size, packed.data(), packed.size()), Z_OK);
  EXPECT_EQ(size, bytes.size());
  std::vector<T> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    unsigned char one[sizeof(T)];
    for (std::size_t b = 0; b < sizeof(T); ++b) one[b] = bytes[b * count + i];
    std::memcpy(&out[i], one, sizeof(T));
  }
  return out;
}

std::vector<double> noise(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> between(-2, 5);
  std::vector<double> values(count);
  for (double& value : values) value = between(random);
  return values;
}

TEST(Base64, agrees_with_rfc_4648) {
  const auto of = [](const std::string& text) {
    return base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
  };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(of("\xff\xff\xfe"), "///+");
}

TEST(Blocks, numbers_come_back_as_stored) {
  const auto values = noise(999);
  Blocks blocks;
  EXPECT_EQ(blocks.add(values, 3, BlockType::real64), 0);
  EXPECT_EQ(blocks.add(values, 3, BlockType::real32), 1);
  EXPECT_EQ(unpacked<double>(blocks.texts()[0], 999), values);
  const auto singles = unpacked<float>(blocks.texts()[1], 999);
  for (std::size_t i = 0; i < 999; ++i) EXPECT_EQ(singles[i], static_cast<float>(values[i]));
  EXPECT_EQ(blocks.infos()[0]["count"], 333);
}

TEST(Blocks, rounding_errs_by_half_a_code_and_keeps_ends_and_gaps) {
  auto values = noise(1000);
  values[7] = std::numeric_limits<double>::quiet_NaN();
  values[10] = -2.5, values[20] = 5.5;  // both of component 0
  Blocks blocks;
  blocks.add(values, 2, BlockType::rounded16);
  const auto codes = unpacked<std::uint16_t>(blocks.texts()[0], 1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    const double low = blocks.infos()[0]["low"][i % 2], high = blocks.infos()[0]["high"][i % 2];
    if (i == 7) {
      EXPECT_EQ(codes[i], 65535);
    } else {
      EXPECT_NEAR(low + (high - low) * codes[i] / 65534, values[i], 0.5001 * (high - low) / 65534);
    }
  }
  EXPECT_EQ(codes[10], 0);
  EXPECT_EQ(codes[20], 65534);
}

TEST(Blocks, equal_blocks_are_kept_once_and_equal_rows_as_one) {
  const auto values = noise(300);
  Blocks blocks;
  const int first = blocks.add(values, 3, BlockType::real32);
  EXPECT_EQ(blocks.add(values, 3, BlockType::real32), first);
  EXPECT_NE(blocks.add(values, 1, BlockType::real32), first);
  const std::size_t bytes = blocks.bytes();
  const int mass = blocks.add(std::vector<double>(5000, 0.4), 1, BlockType::rounded16);
  EXPECT_EQ(blocks.infos()[mass]["constant"][0], 0.4);
  EXPECT_EQ(blocks.bytes(), bytes);
}

TEST(Fit, thins_no_more_than_it_must) {
  constexpr std::size_t megabyte = 1'000'000;
  const Thinning all = fit(20 * megabyte, 20, 10'000, 30, 14);
  EXPECT_FALSE(all.rounded);
  EXPECT_EQ(all.share, 1);
  EXPECT_EQ(all.frames, 20);
  const Thinning rounded = fit(5 * megabyte, 20, 10'000, 30, 14);
  EXPECT_TRUE(rounded.rounded);
  EXPECT_EQ(rounded.share, 1);
  for (const std::size_t particles : {100'000, 1'000'000, 30'000'000})
    for (const std::size_t frames : {1, 21, 500}) {
      const Thinning thin = fit(20 * megabyte, frames, particles, 30, 14);
      const double bytes = thin.share * static_cast<double>(particles * thin.frames) * 14;
      EXPECT_LE(bytes, 20e6);
      if (thin.share < 1 || thin.frames < frames) {
        EXPECT_GE(bytes, 17e6) << particles << " x " << frames;
      }
      EXPECT_GE(thin.frames, std::min<std::size_t>(frames, 10));
    }
}

TEST(Page, is_the_one_that_is_checked_in_and_has_a_place_for_data) {
  EXPECT_EQ(report_page(), read_text(std::filesystem::path(UNDINE_SOURCE_DIR) / "viewer/dist/page.html"));
  EXPECT_NE(report_page().find("<!--UNDINE-DATA-->"), std::string_view::npos);
  EXPECT_EQ(colour_maps_json(), read_text(std::filesystem::path(UNDINE_SOURCE_DIR) / "viewer/colour_maps.json"));
}

}  // namespace
}  // namespace undine
