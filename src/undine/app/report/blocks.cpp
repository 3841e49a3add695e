#include "undine/app/report/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <zlib.h>

#include "undine/core/error.hpp"
#include "undine/io/checksum.hpp"

namespace undine {
namespace {

constexpr double most_code = 65534;
constexpr std::uint16_t code_of_nothing = 65535;
constexpr std::size_t around_text = 48;  ///< bytes of the element that holds a block

/// Byte b of every number, for b = 0, 1, ...: neighbours in space differ little in their high bytes, which then shrink.
template <class T>
std::vector<unsigned char> shuffled(const std::vector<T>& numbers) {
  std::vector<unsigned char> bytes(numbers.size() * sizeof(T));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    unsigned char of_one[sizeof(T)];
    std::memcpy(of_one, &numbers[i], sizeof(T));
    for (std::size_t b = 0; b < sizeof(T); ++b) bytes[b * numbers.size() + i] = of_one[b];
  }
  return bytes;
}

std::vector<unsigned char> deflated(const std::vector<unsigned char>& bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<unsigned char> packed(size);
  if (compress2(packed.data(), &size, bytes.data(), bytes.size(), 1) != Z_OK)
    throw Error({.what = "cannot compress the numbers of a page", .why = "zlib failed"});
  packed.resize(size);
  return packed;
}

/// Whether all rows are the same, bit by bit.
template <class T>
bool constant(const std::vector<T>& numbers, std::size_t width) {
  for (std::size_t i = width; i < numbers.size(); ++i)
    if (std::memcmp(&numbers[i], &numbers[i - width], sizeof(T)) != 0) return false;
  return !numbers.empty();
}

const char* type_name(BlockType type) {
  switch (type) {
    case BlockType::real64:
      return "f64";
    case BlockType::real32:
      return "f32";
    case BlockType::rounded16:
      return "u16";
    default:
      return "i32";
  }
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// Of the finite values of each component; 0 to 0 where there are none.
std::vector<Range> ranges(std::span<const double> values, std::size_t width) {
  std::vector<Range> all(width);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    Range& range = all[i % width];
    range.low = std::min(range.low, values[i]);
    range.high = std::max(range.high, values[i]);
  }
  for (Range& range : all)
    if (!(range.low <= range.high)) range = {0, 0};
  return all;
}

std::vector<std::uint16_t> rounded(std::span<const double> values, const std::vector<Range>& limits) {
  std::vector<std::uint16_t> codes(values.size(), code_of_nothing);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [low, high] = limits[i % limits.size()];
    if (!std::isfinite(values[i])) continue;
    codes[i] = high > low ? static_cast<std::uint16_t>(std::lround((values[i] - low) / (high - low) * most_code)) : 0;
  }
  return codes;
}

template <class To, class From>
std::vector<To> converted(std::span<const From> values) {
  std::vector<To> out(values.size());
  std::ranges::transform(values, out.begin(), [](From value) { return static_cast<To>(value); });
  return out;
}

}  // namespace

std::string base64(std::span<const unsigned char> bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned word = bytes[i] << 16 | (left > 1 ? bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
    text += digits[word >> 18];
    text += digits[word >> 12 & 63];
    text += left > 1 ? digits[word >> 6 & 63] : '=';
    text += left > 2 ? digits[word & 63] : '=';
  }
  return text;
}

template <class T>
int Blocks::store(const std::vector<T>& numbers, Json info, Key key) {
  const auto number = static_cast<int>(texts_.size());
  if (info.contains("constant")) {
    texts_.emplace_back();
  } else {
    texts_.push_back(base64(deflated(shuffled(numbers))));
    bytes_ += texts_.back().size() + around_text;
  }
  infos_.push_back(std::move(info));
  known_.emplace(key, number);
  return number;
}

int Blocks::add(std::span<const double> values, int components, BlockType type) {
  const auto width = static_cast<std::size_t>(components);
  Hash64 hash;
  hash.add_values(values);
  const Key key{hash.value(), values.size(), components, type};
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  Json info{{"type", type_name(type)}, {"count", values.size() / width}, {"components", components}};
  if (const std::vector<double> numbers(values.begin(), values.end()); constant(numbers, width)) {
    info["type"] = type == BlockType::real64 ? "f64" : "f32";
    info["constant"] = std::vector<double>(values.begin(), values.begin() + components);
    return store(numbers, std::move(info), key);
  }
  if (type == BlockType::real64) return store(converted<double>(values), std::move(info), key);
  if (type == BlockType::real32) return store(converted<float>(values), std::move(info), key);
  const auto limits = ranges(values, width);
  for (const Range& range : limits) {
    info["low"].push_back(range.low);
    info["high"].push_back(range.high);
  }
  return store(rounded(values, limits), std::move(info), key);
}

int Blocks::add_whole(std::span<const std::int64_t> values) {
  Hash64 hash;
  hash.add_values(values);
  const Key key{hash.value(), values.size(), 1, BlockType::whole32};
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  Json info{{"type", "i32"}, {"count", values.size()}, {"components", 1}};
  const auto numbers = converted<std::int32_t>(values);
  if (constant(numbers, 1)) info["constant"] = {numbers[0]};
  return store(numbers, std::move(info), key);
}

}  // namespace undine
