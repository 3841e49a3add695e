#pragma once
#include "undine/geometry/shape.hpp"
#include "undine/io/case/table.hpp"

namespace undine {

/// The shape that a table describes: `type` and the keys of that type (docs/write-a-case.md). Lengths in m; in fewer
/// than three dimensions points have fewer coordinates. Throws InputError at the table's place.
ShapePtr read_shape(const Table& table, int dimensions);

/// A point of `dimensions` coordinates; those it lacks are 0.
Vec3 read_point(const Table& table, std::string_view key, int dimensions);

}  // namespace undine
