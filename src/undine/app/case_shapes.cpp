#include "undine/app/case_shapes.hpp"

#include <utility>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/geometry/mesh.hpp"

namespace undine {
namespace {

std::vector<ShapePtr> read_parts(const Table& table, std::string_view key, int dimensions) {
  std::vector<ShapePtr> parts;
  for (const Table& part : table.tables(key)) parts.push_back(read_shape(part, dimensions));
  if (parts.empty())
    table.fail(key, "'" + std::string(key) + "' names no shapes", {},
               "give a list of shapes: " + std::string(key) + " = [{ type = \"box\", ... }]");
  return parts;
}

ShapePtr box(const Table& t, int dimensions) {
  return make_box(read_point(t, "low", dimensions), read_point(t, "high", dimensions), dimensions);
}
ShapePtr sphere(const Table& t, int dimensions) {
  return make_sphere(read_point(t, "centre", dimensions), t.positive("radius", unit::length));
}
ShapePtr cylinder(const Table& t, int dimensions) {
  return make_cylinder(read_point(t, "from", dimensions), read_point(t, "to", dimensions),
                       t.positive("radius", unit::length));
}
ShapePtr half_space(const Table& t, int dimensions) {
  const auto n = t.quantities("normal", unit::one, dimensions);
  Vec3 normal{};
  for (int k = 0; k < dimensions; ++k) normal[k] = n[k];
  return make_half_space(read_point(t, "point", dimensions), normal);
}
ShapePtr polygon(const Table& t, int) {
  const auto a = t.quantities("x", unit::length, -1);
  const std::string plane = t.choice("plane", {"xy", "xz"}, "xy");
  const auto b = t.quantities(plane == "xy" ? "y" : "z", unit::length, static_cast<int>(a.size()));
  PolygonSpec spec;
  for (std::size_t k = 0; k < a.size(); ++k) spec.corners.push_back({a[k], b[k]});
  spec.plane = plane == "xy" ? PolygonPlane::xy : PolygonPlane::xz;
  spec.extrude_from = t.has("extrude_from") ? t.quantity("extrude_from", unit::length) : -unbounded;
  spec.extrude_to = t.has("extrude_to") ? t.quantity("extrude_to", unit::length) : unbounded;
  return make_polygon(spec);
}
ShapePtr mesh(const Table& t, int) {
  return make_mesh(load_stl(existing_file(t, "file").string(), t.positive("scale", unit::one, 1.0)));
}
ShapePtr union_of(const Table& t, int dimensions) { return make_union(read_parts(t, "parts", dimensions)); }
ShapePtr intersection(const Table& t, int dimensions) { return make_intersection(read_parts(t, "parts", dimensions)); }
ShapePtr difference(const Table& t, int dimensions) {
  ShapePtr whole = read_shape(t.table("whole"), dimensions);
  for (const ShapePtr& hole : read_parts(t, "holes", dimensions)) whole = make_difference(whole, hole);
  return whole;
}

/// The one list of shapes.
const std::vector<std::pair<std::string, ShapePtr (*)(const Table&, int)>> shape_readers{{"box", box},
                                                                                         {"sphere", sphere},
                                                                                         {"cylinder", cylinder},
                                                                                         {"half_space", half_space},
                                                                                         {"polygon", polygon},
                                                                                         {"mesh", mesh},
                                                                                         {"union", union_of},
                                                                                         {"intersection", intersection},
                                                                                         {"difference", difference}};

}  // namespace

Vec3 read_point(const Table& table, std::string_view key, int dimensions) {
  const auto coordinates = table.quantities(key, unit::length, dimensions);
  Vec3 point{};
  for (int k = 0; k < dimensions; ++k) point[k] = coordinates[k];
  return point;
}

std::filesystem::path existing_file(const Table& table, std::string_view key) {
  const std::filesystem::path file = table.path(key);
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure))
    table.fail(key, fmt::format("there is no file '{}'", file.string()), {},
               "check the path; names are relative to the case file's folder");
  return file;
}

ShapePtr read_shape(const Table& table, int dimensions) {
  std::vector<std::string> types;
  for (const auto& [name, reader] : shape_readers) types.push_back(name);
  const std::string type = table.choice("type", types);
  try {
    for (const auto& [name, reader] : shape_readers)
      if (name == type) return reader(table, dimensions);
  } catch (const InputError& error) {
    if (error.parts().where.line > 0) throw;
    auto parts = error.parts();  // the geometry knows no case file: say where the shape stands
    parts.why = parts.where.file.empty() ? parts.why : parts.where.text() + (parts.why.empty() ? "" : ": " + parts.why);
    parts.where = table.where();
    throw InputError(std::move(parts));
  }
  return nullptr;
}

}  // namespace undine
