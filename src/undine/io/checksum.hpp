#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "undine/io/frame.hpp"

namespace undine {

/// The 64-bit hash XXH64 (seed 0) of a stream of bytes; `xxhsum -H1` gives the same. Guards against damage, not against
/// malice.
class Hash64 {
 public:
  void add(std::span<const std::byte> bytes);
  template <class T>
  void add_values(std::span<const T> values) {
    add(std::as_bytes(values));
  }
  std::uint64_t value() const;
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  std::array<std::uint64_t, 4> lanes_ = {0x60ea27eeadc0b5d6, 0xc2b2ae3d27d4eb4f, 0, 0x61c8864e7a143579};
  std::array<std::byte, 32> rest_ = {};  // bytes that do not yet fill a block
  std::size_t rest_size_ = 0;
  std::uint64_t size_ = 0;
};

/// 16 hexadecimal digits that two particle sets share only if they are bitwise the same: time, step, dimensions and
/// every column (name, components, values), with columns in order of name and particles in order of `id`, where there
/// is one. All NaNs count as one value; units and the width of whole numbers do not count.
std::string checksum(const OwnedFrame& frame);

/// The checksum of the particles of a snapshot or a checkpoint. Throws InputError.
std::string checksum_file(const std::filesystem::path& path);

}  // namespace undine
