#include "undine/app/setup/ghosts.hpp"

#include <cmath>

#include <fmt/format.h>

#include "undine/app/setup/filling.hpp"
#include "undine/core/error.hpp"

namespace undine {
namespace {

/// Whether a face of a part is an open face of a box: its normal, out of the wall, points along an axis into the fluid.
bool is_open(const FlatPart& part, const FaceSet& open) {
  if (part.size() != 1) return false;
  for (int k = 0; k < 3; ++k) {
    const double into_fluid = part.front().normal[k];
    if (std::abs(into_fluid) > 0.5 && open.has(k, into_fluid > 0 ? 0 : 1)) return true;
  }
  return false;
}

template <int N>
walls::Solid<N> narrow(const FlatPart& part, const std::string& name) {
  walls::Solid<N> solid{.faces = {}, .name = name};
  for (const FlatFace& face : part) {
    walls::Plane<N> plane;
    for (int k = 0; k < N; ++k) plane.normal[k] = face.normal[k] == 0 ? 0.0 : face.normal[k];
    plane.offset = dot(face.normal, face.point);
    if (norm_sq(plane.normal) > 0.5) solid.faces.push_back(plane);
  }
  return solid;
}

}  // namespace

template <int N>
void GhostWalls<N>::add(const Table& wall, const std::string& name, const Shape& shape, Side fluid,
                        const FaceSet& open) {
  const bool tank = fluid == Side::inside && shape.as_box();
  bool any_open = false;
  for (int k = 0; k < 3; ++k) any_open = any_open || open.has(k, 0) || open.has(k, 1);
  if (any_open && !tank)
    wall.fail("open", "only a box can have open faces", "with ghosts, only one with the fluid inside",
              "use a box, or leave 'open' out");
  std::vector<FlatPart> parts;
  if (!shape.flat_parts(fluid == Side::inside ? Side::outside : Side::inside, parts))
    throw InputError({.what = fmt::format("ghosts cannot mirror the fluid at wall '{}'", name),
                      .where = wall.where("shape"),
                      .why = "they need flat faces: boxes, half-spaces, unions of these with the fluid outside, "
                             "differences with the fluid inside",
                      .fix = "use such shapes, or another treatment such as \"adami\""});
  for (const FlatPart& part : parts) {
    if (tank && is_open(part, open)) continue;
    auto solid = narrow<N>(part, name);
    if (!solid.faces.empty()) solids_.push_back(std::move(solid));
  }
  tables_.push_back(wall);
}

template <int N>
std::shared_ptr<const walls::Mirrors<N>> GhostWalls<N>::mirrors(walls::Slip slip, double reach,
                                                                const Domain<N>& domain) const {
  const auto make = [&] { return std::make_shared<const walls::Mirrors<N>>(solids_, slip, reach, domain); };
  return tables_.empty() ? make() : with_place(tables_.front(), make);
}

template class GhostWalls<1>;
template class GhostWalls<2>;
template class GhostWalls<3>;

}  // namespace undine
