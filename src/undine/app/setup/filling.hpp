#pragma once
// What laying particles into shapes shares, of fluids and of walls.
#include "undine/core/error.hpp"
#include "undine/geometry/shape.hpp"
#include "undine/io/case/table.hpp"

namespace undine {

/// Throws InputError at the table if `count` particles do not fit into this machine's memory.
void check_room(const Table& table, double count, double spacing);

/// How a shape is to be filled with particles.
struct Filling {
  double spacing = 0;  ///< m
  int dimensions = 3;
  int layers = 0;  ///< of a wall, on one `side` of its surface; 0: the shape itself is filled
  Side side = Side::outside;
};

/// Refuses a shape whose filling would not end.
void check_filling(const Table& table, const Shape& shape, const Filling& filling);

/// f(), whose errors get the table's place where they have none.
template <class F>
auto with_place(const Table& table, F&& f) {
  try {
    return f();
  } catch (const InputError& error) {
    if (error.parts().where.line > 0) throw;
    auto parts = error.parts();
    parts.where = table.where();
    throw InputError(std::move(parts));
  }
}

}  // namespace undine
