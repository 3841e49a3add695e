#pragma once
#include <filesystem>
#include <string_view>

#include "undine/geometry/shape.hpp"
#include "undine/io/case/table.hpp"

namespace undine {

/// The shape that a table describes: `type` and the keys of that type (docs/write-a-case.md). Lengths in m; in fewer
/// than three dimensions points have fewer coordinates. Throws InputError at the table's place.
ShapePtr read_shape(const Table& table, int dimensions);

/// A point of `dimensions` coordinates; those it lacks are 0.
Vec3 read_point(const Table& table, std::string_view key, int dimensions);

/// The file that a key names, which must exist. Throws InputError at the key.
std::filesystem::path existing_file(const Table& table, std::string_view key);

}  // namespace undine
