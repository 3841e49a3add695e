#pragma once
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "undine/core/error.hpp"
#include "undine/io/frame.hpp"

namespace undine::test {

/// A new folder, removed at the end of a test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "undine_io_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// What an action complains of; empty if it does not.
inline std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Particles with a scalar, a vector, a tensor, an identity and a group.
inline OwnedFrame sample_frame(std::size_t particles, int dimensions) {
  const auto values = [&](int components, double phase) {
    std::vector<double> all(particles * static_cast<std::size_t>(components));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::sin(0.37 * static_cast<double>(i) + phase) / 3;
    return all;
  };
  OwnedFrame frame;
  frame.time = 0.1;
  frame.step = 42;
  frame.dimensions = dimensions;
  frame.particles = particles;
  const int square = dimensions * dimensions;
  frame.columns = {{"rho", "kg/m^3", 1, values(1, 1)},
                   {"x", "m", dimensions, values(dimensions, 2)},
                   {"v", "m/s", dimensions, values(dimensions, 3)},
                   {"stress", "Pa", square, values(square, 4)}};
  std::vector<std::int64_t> id(particles);
  std::vector<std::int32_t> group(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    id[i] = static_cast<std::int64_t>((std::uint64_t{1} << 40) + particles - i);
    group[i] = static_cast<std::int32_t>(i % 3);
  }
  frame.integers = {{"id", id}, {"group", group}};
  return frame;
}

}  // namespace undine::test
