#include "undine/geometry/surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

/// How far inside the fluid a path goes on after a hit, relative to the size of the walls: some 1e4 rounding errors.
constexpr double relative_inset = 1e-12;
constexpr int settling_steps = 48;

double largest(const Vec3& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}); }
bool finite(const Vec3& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

}  // namespace

FaceSet parse_faces(const std::vector<std::string>& names) {
  FaceSet faces;
  for (const auto& name : names) {
    const bool known = name.size() == 2 && name[0] >= 'x' && name[0] <= 'z' && (name[1] == '-' || name[1] == '+');
    if (!known) {
      throw InputError({.what = fmt::format("unknown face '{}'", name), .fix = "use x-, x+, y-, y+, z- or z+"});
    }
    faces.add(name[0] - 'x', name[1] == '+' ? 1 : 0);
  }
  return faces;
}

struct ReflectingSurface::Contact {
  const Wall* wall;
  Crossing at;  ///< normal towards the fluid
};

double ReflectingSurface::Wall::depth(const Vec3& p) const {
  const double d = shape->signed_distance(p - offset);
  return fluid == Side::inside ? -d : d;
}

Vec3 ReflectingSurface::Wall::normal(const Vec3& p) const {
  const Vec3 n = shape->normal(p - offset);
  return fluid == Side::inside ? -n : n;
}

std::optional<Crossing> ReflectingSurface::Wall::first_crossing(const Vec3& from, const Vec3& to) const {
  auto crossing = shape->first_crossing(from - offset, to - offset, fluid);
  if (crossing) crossing->point += offset;
  return crossing;
}

std::size_t ReflectingSurface::add_tank(const Bounds& box, int dimensions, const FaceSet& open, double restitution) {
  Bounds walls = box;
  for (int k = 0; k < 3; ++k) {
    if (open.has(k, 0)) walls.lo[k] = -unbounded;
    if (open.has(k, 1)) walls.hi[k] = unbounded;
  }
  return add(make_box(walls.lo, walls.hi, dimensions), Side::inside, restitution);
}

std::size_t ReflectingSurface::add(ShapePtr shape, Side fluid, double restitution) {
  if (!shape) throw InputError({.what = "a reflecting wall needs a shape"});
  if (!(restitution >= 0 && restitution <= 1)) {
    throw InputError({.what = "the restitution of a wall must lie in 0..1",
                      .why = fmt::format("it is {}", restitution),
                      .fix = "1 keeps the normal speed, 0 takes all of it"});
  }
  const Bounds bounds = shape->bounds();
  const bool tank = fluid == Side::inside && shape->as_box().has_value();
  scale_ = std::max(scale_, bounds.scale());
  walls_.push_back({std::move(shape), fluid, restitution, bounds, tank});
  return walls_.size() - 1;
}

std::size_t ReflectingSurface::add_plane(const Vec3& point, const Vec3& normal_to_fluid, double restitution) {
  scale_ = std::max(scale_, largest(point));
  return add(make_half_space(point, normal_to_fluid), Side::outside, restitution);
}

void ReflectingSurface::place(std::size_t wall, const Vec3& offset, const Vec3& velocity) {
  walls_[wall].offset = offset;
  walls_[wall].velocity = velocity;
}

Vec3 ReflectingSurface::pushed_out(Vec3 p, double distance) const {
  constexpr int most_pushes = 4;  // one for each wall of a corner, and one more
  for (int push = 0; push < most_pushes; ++push) {
    double depth = unbounded;
    const Wall* wall = nearest(p, depth);
    if (!wall || !(depth < distance)) break;
    p += (distance - depth) * wall->normal(p);
  }
  return p;
}

const ReflectingSurface::Wall* ReflectingSurface::nearest(const Vec3& p, double& depth) const {
  const Wall* wall = nullptr;
  depth = unbounded;
  for (const Wall& w : walls_) {
    if (const double d = w.depth(p); d < depth) depth = d, wall = &w;
  }
  return wall;
}

double ReflectingSurface::depth(const Vec3& p) const {
  double depth = unbounded;
  nearest(p, depth);
  return depth;
}

/// Moved along the normals until p is at least inset/2 inside the fluid. The aim grows with each step, so that a point
/// in a sharp edge, where pushing off one wall leads into the other, comes free too.
std::optional<Vec3> ReflectingSurface::settled(Vec3 p, double inset) const {
  double aim = inset;
  for (int step = 0; step < settling_steps; ++step) {
    double depth = unbounded;
    const Wall* wall = nearest(p, depth);
    if (!wall || depth >= 0.5 * inset) return p;
    p += (aim - depth) * wall->normal(p);
    if (step >= 3) aim *= 1.5;
  }
  return std::nullopt;
}

/// For a path that ends in a wall although no crossing was found (a rounding error at an edge): halve it.
ReflectingSurface::Contact ReflectingSurface::search_contact(const Vec3& from, const Vec3& to) const {
  double good = 0;
  double bad = 1;
  for (int step = 0; step < 60 && bad - good > 1e-16; ++step) {
    const double middle = 0.5 * (good + bad);
    (depth(from + middle * (to - from)) > 0 ? good : bad) = middle;
  }
  const Vec3 beyond = from + bad * (to - from);
  double depth = 0;
  const Wall* wall = nearest(beyond, depth);
  return {wall, {good, from + good * (to - from), wall->normal(beyond)}};
}

std::optional<ReflectingSurface::Contact> ReflectingSurface::first_contact(const Vec3& from, const Vec3& to) const {
  std::optional<Contact> first;
  for (const Wall& wall : walls_) {
    if (wall.clear(from, to)) continue;
    const auto crossing = wall.first_crossing(from, to);
    if (crossing && (!first || crossing->fraction < first->at.fraction)) first = Contact{&wall, *crossing};
  }
  return first;
}

Reflection ReflectingSurface::reflect(const Vec3& from, const Vec3& to, const Vec3& velocity) const {
  Reflection result{to, velocity, 0, {}, norm(to - from), false};
  if (clear(from, to)) return result;
  result.stopped = true;
  if (!finite(from) || !finite(to)) return result;
  const double inset = relative_inset * std::max(scale_, largest(from));
  const auto start = settled(from, inset);
  if (!start) return result;
  Vec3 a = *start;
  Vec3 b = to;
  result.travelled = 0;
  result.stopped = false;
  while (true) {
    auto contact = first_contact(a, b);
    if (!contact && !(depth(b) > 0)) {
      // Just on a wall, or on a face that two parts of a union share: a hair off it, or else a missed crossing.
      const auto off = settled(b, inset);
      if (off && norm(*off - b) <= 4 * inset && !first_contact(a, *off)) {
        b = *off;
      } else {
        contact = search_contact(a, b);
      }
    }
    if (!contact) break;
    ++result.hits;
    const auto& [fraction, point, n] = contact->at;
    const double back = 1 + contact->wall->restitution;
    Vec3 rest = b - point;
    rest -= back * std::min(0.0, dot(rest, n)) * n;
    result.velocity -= back * std::min(0.0, dot(result.velocity - contact->wall->velocity, n)) * n;
    result.travelled += norm(point - a);
    const auto next = settled(point + inset * n, inset);
    b = next ? *next + rest : a;
    a = next.value_or(a);
    if (next && result.hits < most_hits) continue;
    // Out of patience: stay at the last hit. Where the wall takes speed a path may slide round a hollow with ever
    // shorter hops: there go to the free place nearest to the end, if nothing is in the way.
    const auto end = next && back < 2 ? settled(b, inset) : std::nullopt;
    const bool slide = end && norm(*end - b) <= norm(rest) && !first_contact(a, *end);
    result.stopped = !slide;
    b = slide ? *end : a;
    break;
  }
  result.travelled += norm(b - a);
  result.position = b;
  result.velocity_change = result.velocity - velocity;
  return result;
}

}  // namespace undine
