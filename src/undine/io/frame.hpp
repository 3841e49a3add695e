#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace undine {

/// One real quantity of every particle, not owned: component k of particle i is data[i * components + k].
struct Column {
  std::string name;
  std::string unit;              ///< such as "m/s"; empty: dimensionless
  int components = 1;            ///< 1 (scalar), N (vector), N*N (tensor, row by row), or any other count
  const double* data = nullptr;  ///< particles * components values
};

/// One whole number of every particle, not owned: an identity (64 bits), or a material or group (32 bits).
struct IntColumn {
  std::string name;
  std::variant<const std::int64_t*, const std::int32_t*> data;

  std::int64_t at(std::size_t particle) const {
    return std::visit([&](auto values) { return static_cast<std::int64_t>(values[particle]); }, data);
  }
};

/// The neutral picture of a particle set at one time, which points into arrays that live elsewhere. Names are unique
/// over both kinds of column, and hold no '/'.
struct Frame {
  double time = 0;  ///< s
  std::int64_t step = 0;
  int dimensions = 3;  ///< 1, 2 or 3
  std::size_t particles = 0;
  std::string position = "x";  ///< name of the column that says where the particles are, with `dimensions` components
  std::vector<Column> columns = {};
  std::vector<IntColumn> integers = {};
};

/// Name of the integer column that tells particles apart whatever their order.
inline constexpr std::string_view identity_column = "id";

/// Throws Error where a frame contradicts itself: a missing array, a bad or repeated name, an impossible count, or no
/// position.
void check(const Frame& frame);

struct OwnedColumn {
  std::string name;
  std::string unit;
  int components = 1;
  std::vector<double> data;  ///< particles * components values
};

struct OwnedIntColumn {
  std::string name;
  std::variant<std::vector<std::int64_t>, std::vector<std::int32_t>> data;

  std::int64_t at(std::size_t particle) const {
    return std::visit([&](const auto& values) { return static_cast<std::int64_t>(values[particle]); }, data);
  }
};

/// A frame that owns its arrays: what is read back from a file.
struct OwnedFrame {
  double time = 0;  ///< s
  std::int64_t step = 0;
  int dimensions = 3;
  std::size_t particles = 0;
  std::string position = "x";
  std::vector<OwnedColumn> columns = {};
  std::vector<OwnedIntColumn> integers = {};

  /// Points into this frame; valid while this frame lives and is not changed.
  Frame view() const;
  /// The column of that name, or nullptr.
  const OwnedColumn* find(std::string_view name) const;
  const OwnedIntColumn* find_integers(std::string_view name) const;
};

OwnedFrame copy(const Frame& frame);

}  // namespace undine
