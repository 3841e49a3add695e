#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace undine::fuzz {

enum class Hdf5Kind { group, real, whole, text };

/// A group, a data set or, where `attribute` is not empty, an attribute of a file that is as it should be.
struct Hdf5Object {
  std::string name;
  std::string attribute = {};
  Hdf5Kind kind = Hdf5Kind::real;
  std::uint64_t rows = 0, columns = 0;  ///< 0, 0: one value; columns 0: a list
  std::int64_t value = 1;               ///< of every number
  std::string text = {};
};

/// Where the bytes start with "made", writes a sound HDF5 file of these objects, some of which the other bytes leave
/// out, or give another type, rank, size, layout or value. Otherwise does nothing and returns false.
bool make_hdf5(const std::filesystem::path& path, std::size_t user_block, const std::vector<Hdf5Object>& objects,
               const std::uint8_t* data, std::size_t size);

}  // namespace undine::fuzz
