#include "undine/geometry/shape.hpp"

#include <cmath>

namespace undine {

std::optional<Crossing> Shape::first_crossing(const Vec3& from, const Vec3& to, Side side) const {
  if (from == to) return std::nullopt;
  for (const Span& span : spans(from, to)) {
    if (side == Side::inside && span.end_cut) {
      return Crossing{span.end, from + span.end * (to - from), -span.end_normal};
    }
    if (side == Side::outside && span.begin_cut) {
      return Crossing{span.begin, from + span.begin * (to - from), span.begin_normal};
    }
  }
  return std::nullopt;
}

bool Shape::clear(const Vec3& from, const Vec3& to, Side side) const {
  const double d = signed_distance(from);
  const double depth = side == Side::inside ? -d : d;
  return depth > 0 && sq(depth) > norm_sq(to - from) * (1 + 1e-12);
}

bool Shape::flat_parts(Side, std::vector<FlatPart>&) const { return false; }

}  // namespace undine
