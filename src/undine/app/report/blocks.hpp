#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "undine/io/run_record.hpp"

namespace undine {

/// How the numbers of a block are kept.
enum class BlockType { real64, real32, rounded16, whole32 };

/// Blocks of numbers of a page: each once, however often it is used. A block of equal rows is its row in the JSON;
/// any other is base64 of a zlib stream of its bytes, the first bytes of all numbers first. rounded16 keeps a number as
/// 0..65534 between the lowest and the highest of its component; 65535 is a number that is not finite.
class Blocks {
 public:
  /// Rows of `components` numbers. Returns the block's number.
  int add(std::span<const double> values, int components, BlockType type);
  int add_whole(std::span<const std::int64_t> values);

  /// What the page must know of each block: type, count, components, low, high, constant.
  const Json& infos() const { return infos_; }
  /// The texts of the blocks; empty for those of equal rows.
  const std::vector<std::string>& texts() const { return texts_; }
  /// Of all texts, with what stands around them.
  std::size_t bytes() const { return bytes_; }

 private:
  using Key = std::tuple<std::uint64_t, std::size_t, int, BlockType>;
  template <class T>
  int store(const std::vector<T>& numbers, Json info, Key key);

  Json infos_ = Json::array();
  std::vector<std::string> texts_;
  std::map<Key, int> known_;
  std::size_t bytes_ = 0;
};

std::string base64(std::span<const unsigned char> bytes);

}  // namespace undine
