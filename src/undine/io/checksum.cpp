#include "undine/io/checksum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "undine/io/checkpoint.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

static_assert(std::endian::native == std::endian::little, "checksums are taken over little-endian bytes");

// XXH64, Y. Collet, "xxHash fast digest algorithm", specification version 0.1.1.
constexpr std::uint64_t prime1 = 0x9e3779b185ebca87;
constexpr std::uint64_t prime2 = 0xc2b2ae3d27d4eb4f;
constexpr std::uint64_t prime3 = 0x165667b19e3779f9;
constexpr std::uint64_t prime4 = 0x85ebca77c2b2ae63;
constexpr std::uint64_t prime5 = 0x27d4eb2f165667c5;

template <class T>
std::uint64_t load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

constexpr std::uint64_t round(std::uint64_t lane, std::uint64_t input) {
  return std::rotl(lane + input * prime2, 31) * prime1;
}

constexpr std::uint64_t merge(std::uint64_t hash, std::uint64_t lane) {
  return (hash ^ round(0, lane)) * prime1 + prime4;
}

void add_block(std::array<std::uint64_t, 4>& lanes, const std::byte* block) {
  for (std::size_t k = 0; k < 4; ++k) lanes[k] = round(lanes[k], load<std::uint64_t>(block + 8 * k));
}

void add_text(Hash64& hash, const std::string& text) {
  const std::uint64_t size = text.size();
  hash.add_values(std::span(&size, 1));
  hash.add_values(std::span(text));
}

/// Particles in order of identity; in the order of the file where they have none.
std::vector<std::size_t> particle_order(const OwnedFrame& frame) {
  std::vector<std::size_t> order(frame.particles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (const OwnedIntColumn* identity = frame.find_integers(identity_column))
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return identity->at(i); });
  return order;
}

void add_column(Hash64& hash, const OwnedColumn& column, const std::vector<std::size_t>& order) {
  const auto components = static_cast<std::size_t>(column.components);
  const std::int64_t kind = column.components;
  hash.add_values(std::span(&kind, 1));
  std::vector<double> row(components);
  for (const std::size_t i : order) {
    for (std::size_t k = 0; k < components; ++k) {
      const double value = column.data[i * components + k];
      row[k] = std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value;
    }
    hash.add_values(std::span<const double>(row));
  }
}

void add_column(Hash64& hash, const OwnedIntColumn& column, const std::vector<std::size_t>& order) {
  const std::int64_t kind = 0;
  hash.add_values(std::span(&kind, 1));
  for (const std::size_t i : order) {
    const std::int64_t value = column.at(i);
    hash.add_values(std::span(&value, 1));
  }
}

}  // namespace

void Hash64::add(std::span<const std::byte> bytes) {
  size_ += bytes.size();
  if (rest_size_ > 0) {
    const std::size_t taken = std::min(bytes.size(), rest_.size() - rest_size_);
    std::ranges::copy(bytes.first(taken), rest_.begin() + static_cast<std::ptrdiff_t>(rest_size_));
    rest_size_ += taken;
    bytes = bytes.subspan(taken);
    if (rest_size_ < rest_.size()) return;
    add_block(lanes_, rest_.data());
    rest_size_ = 0;
  }
  for (; bytes.size() >= rest_.size(); bytes = bytes.subspan(rest_.size())) add_block(lanes_, bytes.data());
  std::ranges::copy(bytes, rest_.begin());
  rest_size_ = bytes.size();
}

std::uint64_t Hash64::value() const {
  std::uint64_t hash = prime5;
  if (size_ >= rest_.size()) {
    hash = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) + std::rotl(lanes_[2], 12) + std::rotl(lanes_[3], 18);
    for (const std::uint64_t lane : lanes_) hash = merge(hash, lane);
  }
  hash += size_;
  const std::byte* at = rest_.data();
  const std::byte* const end = at + rest_size_;
  for (; end - at >= 8; at += 8) hash = std::rotl(hash ^ round(0, load<std::uint64_t>(at)), 27) * prime1 + prime4;
  for (; end - at >= 4; at += 4) hash = std::rotl(hash ^ (load<std::uint32_t>(at) * prime1), 23) * prime2 + prime3;
  for (; at != end; ++at) hash = std::rotl(hash ^ (load<std::uint8_t>(at) * prime5), 11) * prime1;
  hash = (hash ^ (hash >> 33)) * prime2;
  hash = (hash ^ (hash >> 29)) * prime3;
  return hash ^ (hash >> 32);
}

std::string Hash64::text() const { return fmt::format("{:016x}", value()); }

std::string checksum(const OwnedFrame& frame) {
  check(frame.view());
  Hash64 hash;
  const std::int64_t counts[] = {frame.dimensions, static_cast<std::int64_t>(frame.particles), frame.step};
  hash.add_values(std::span<const std::int64_t>(counts));
  hash.add_values(std::span(&frame.time, 1));
  const std::vector<std::size_t> order = particle_order(frame);
  std::map<std::string, std::variant<const OwnedColumn*, const OwnedIntColumn*>> by_name;
  for (const OwnedColumn& column : frame.columns) by_name[column.name] = &column;
  for (const OwnedIntColumn& column : frame.integers) by_name[column.name] = &column;
  for (const auto& [name, column] : by_name) {
    add_text(hash, name);
    std::visit([&](const auto* chosen) { add_column(hash, *chosen, order); }, column);
  }
  return hash.text();
}

std::string checksum_file(const std::filesystem::path& path) {
  return checksum(is_checkpoint(path) ? read_checkpoint(path).frame : read_snapshot(path));
}

}  // namespace undine
