// A closed polygon in x-y or x-z, extruded along the third axis.
#include <cmath>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/geometry/shape.hpp"

namespace undine {
namespace {

using Vec2 = Vec<2, double>;

double cross2(const Vec2& a, const Vec2& b) { return a[0] * b[1] - a[1] * b[0]; }

Vec2 nearest_on_edge(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 e = b - a;
  return a + std::clamp(dot(p - a, e) / norm_sq(e), 0.0, 1.0) * e;
}

/// True where two edges meet, by crossing or by touching.
bool edges_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d, double tolerance) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) { return cross2(q - p, r - p); };
  if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
  return norm(nearest_on_edge(a, c, d) - a) <= tolerance || norm(nearest_on_edge(b, c, d) - b) <= tolerance ||
         norm(nearest_on_edge(c, a, b) - c) <= tolerance || norm(nearest_on_edge(d, a, b) - d) <= tolerance;
}

class Polygon final : public Shape {
 public:
  Polygon(std::vector<Vec2> corners, const PolygonSpec& spec)
      : corners_(std::move(corners)),
        v_(spec.plane == PolygonPlane::xy ? 1 : 2),
        w_(3 - v_),
        low_(spec.extrude_from),
        high_(spec.extrude_to) {}

  double signed_distance(const Vec3& p) const override {
    const Nearest near = nearest(flat(p));
    const double side = near.inside ? -near.distance : near.distance;
    const double end = std::max(low_ - p[w_], p[w_] - high_);
    return std::min(std::max(side, end), 0.0) + std::hypot(std::max(side, 0.0), std::max(end, 0.0));
  }

  Vec3 normal(const Vec3& p) const override {
    const Vec2 q = flat(p);
    const Nearest near = nearest(q);
    const double side = near.inside ? -near.distance : near.distance;
    const double end = std::max(low_ - p[w_], p[w_] - high_);
    Vec3 up{};
    up[w_] = low_ - p[w_] > p[w_] - high_ ? -1 : 1;
    // On an edge itself the difference to the nearest point has no direction: take the edge's own normal.
    const bool close = near.distance <= 1e-9 * norm(edge(near.index));
    const Vec2 away = near.inside ? near.point - q : q - near.point;
    const bool corner = near.point == corners_[near.index] || near.point == next(near.index);
    const Vec3 out = close && !(corner && near.distance > 0) ? edge_normal(near.index) : lift(away / near.distance);
    if (side <= 0 && end <= 0) return side > end ? out : up;
    const Vec3 n = std::max(side, 0.0) * out + std::max(end, 0.0) * up;
    return n / norm(n);
  }

  Bounds bounds() const override {
    Bounds box;
    for (const Vec2& c : corners_) {
      Vec3 p = lift(c);
      p[w_] = low_;
      box.include(p);
      p[w_] = high_;
      box.include(p);
    }
    return box;
  }

  bool inside(const Vec3& p) const override { return p[w_] > low_ && p[w_] < high_ && Shape::inside(p); }

  Spans spans(const Vec3& from, const Vec3& to) const override {
    const Vec2 a = flat(from);
    const Vec2 d = flat(to) - a;
    std::vector<Cut> cuts;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec2 e = edge(i);
      const double det = cross2(d, e);
      if (det == 0) continue;
      const Vec2 m = corners_[i] - a;
      const double along = cross2(m, d) / det;
      if (along < -1e-12 || along > 1 + 1e-12) continue;
      cuts.push_back({cross2(m, e) / det, edge_normal(i)});
    }
    const auto in = [&](double t) { return nearest(a + t * d).inside; };
    return both_spans(spans_from_cuts(std::move(cuts), to - from, in), slab(from, to), 0);
  }

 private:
  struct Nearest {
    Vec2 point{};
    double distance = unbounded;
    std::size_t index = 0;
    bool inside = false;
  };

  Vec2 flat(const Vec3& p) const { return {{p[0], p[v_]}}; }
  Vec3 lift(const Vec2& q) const {
    Vec3 p{};
    p[0] = q[0];
    p[v_] = q[1];
    return p;
  }
  const Vec2& next(std::size_t i) const { return corners_[i + 1 < corners_.size() ? i + 1 : 0]; }
  Vec2 edge(std::size_t i) const { return next(i) - corners_[i]; }
  /// Corners run anticlockwise, so that the outside is on the right of an edge.
  Vec3 edge_normal(std::size_t i) const {
    const Vec2 e = edge(i);
    return lift(Vec2{{e[1], -e[0]}} / norm(e));
  }

  Nearest nearest(const Vec2& p) const {
    Nearest best;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec2& a = corners_[i];
      const Vec2& b = next(i);
      const Vec2 q = nearest_on_edge(p, a, b);
      const double d = norm(p - q);
      if (d < best.distance) best.point = q, best.distance = d, best.index = i;
      if ((a[1] > p[1]) != (b[1] > p[1]) && (cross2(b - a, p - a) > 0) == (b[1] > a[1])) best.inside = !best.inside;
    }
    return best;
  }

  Spans slab(const Vec3& from, const Vec3& to) const {
    const double d = to[w_] - from[w_];
    if (d == 0) return from[w_] > low_ && from[w_] < high_ ? Spans{Span{}} : Spans{};
    Vec3 ahead{};
    ahead[w_] = d > 0 ? 1 : -1;
    const double enter = ((d > 0 ? low_ : high_) - from[w_]) / d;
    const double leave = ((d > 0 ? high_ : low_) - from[w_]) / d;
    return convex_spans({enter, -ahead}, {leave, ahead});
  }

  std::vector<Vec2> corners_;
  int v_, w_;
  double low_, high_;
};

[[noreturn]] void refuse(const std::string& why) {
  throw InputError({.what = "the polygon is not a simple closed line",
                    .why = why,
                    .fix = "list the corners once, in order around the outline; the last joins the first by itself"});
}

void check_simple(const std::vector<Vec2>& c, double size) {
  const std::size_t n = c.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = c[i], &b = c[(i + 1) % n], &after = c[(i + 2) % n];
    if (norm(b - a) <= 1e-12 * size) refuse(fmt::format("corners {} and {} coincide", i + 1, (i + 1) % n + 1));
    const Vec2 e = b - a;
    const Vec2 f = after - b;
    if (dot(e, f) < 0 && std::abs(cross2(e, f)) <= 1e-12 * norm(e) * norm(f)) {
      refuse(fmt::format("it turns back on itself at corner {} ({}, {})", (i + 1) % n + 1, b[0], b[1]));
    }
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;
      const Vec2 &p = c[j], &q = c[(j + 1) % n];
      if (!edges_meet(a, b, p, q, 1e-12 * size)) continue;
      refuse(fmt::format("edge {} from ({}, {}) to ({}, {}) meets edge {} from ({}, {}) to ({}, {})", i + 1, a[0], a[1],
                         b[0], b[1], j + 1, p[0], p[1], q[0], q[1]));
    }
  }
}

}  // namespace

ShapePtr make_polygon(const PolygonSpec& spec) {
  std::vector<Vec2> corners;
  Bounds box;
  for (const auto& c : spec.corners) {
    if (!std::isfinite(c[0]) || !std::isfinite(c[1])) {
      refuse(fmt::format("corner {} is ({}, {})", corners.size() + 1, c[0], c[1]));
    }
    corners.push_back({{c[0], c[1]}});
    box.include(Vec3{{c[0], c[1], 0}});
  }
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  if (corners.size() < 3) refuse(fmt::format("it has {} different corners; 3 is the least", corners.size()));
  if (!(spec.extrude_from < spec.extrude_to)) {
    refuse(fmt::format("it is extruded from {} to {}", spec.extrude_from, spec.extrude_to));
  }
  check_simple(corners, box.scale());
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += 0.5 * cross2(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  }
  if (area < 0) std::reverse(corners.begin(), corners.end());
  return std::make_shared<Polygon>(std::move(corners), spec);
}

}  // namespace undine
