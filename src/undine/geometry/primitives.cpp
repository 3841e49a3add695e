// Box, sphere, cylinder and half-space: exact distances and crossings.
#include <cmath>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/geometry/shape.hpp"

namespace undine {
namespace {

bool finite(const Vec3& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

Vec3 unit(int axis, double sign) {
  Vec3 n{};
  n[axis] = sign;
  return n;
}

void require_finite(const Vec3& p, const char* what) {
  if (finite(p)) return;
  throw InputError({.what = fmt::format("{} is not finite", what),
                    .why = fmt::format("it is ({}, {}, {})", p[0], p[1], p[2]),
                    .fix = "give finite coordinates in metres"});
}

void require_radius(double radius, const char* shape) {
  if (std::isfinite(radius) && radius > 0) return;
  throw InputError({.what = fmt::format("a {} needs a radius above 0", shape),
                    .why = fmt::format("the radius is {} m", radius),
                    .fix = "give a positive, finite radius in metres"});
}

// The stretch of the line from + t d inside a sphere about 0 in the plane or space that `from` and `d` span.
// False when it misses, or when d is 0 and decides nothing.
bool round_roots(const Vec3& from, const Vec3& d, double radius, double& in, double& out) {
  const double a = norm_sq(d);
  const double b = dot(from, d);
  const double c = norm_sq(from) - sq(radius);
  const Vec3 nearest = from - (b / a) * d;
  const double disc = a * (sq(radius) - norm_sq(nearest));
  if (!(disc > 0)) return false;
  const double s = -b - std::copysign(std::sqrt(disc), b);
  in = s / a;
  out = c / s;
  if (in > out) std::swap(in, out);
  return true;
}

class BoxShape final : public Shape {
 public:
  explicit BoxShape(const Bounds& box) : box_(box) {}

  double signed_distance(const Vec3& p) const override {
    double outside_sq = 0;
    double nearest = -unbounded;
    for (int k = 0; k < 3; ++k) {
      const double q = std::max(box_.lo[k] - p[k], p[k] - box_.hi[k]);
      nearest = std::max(nearest, q);
      if (q > 0) outside_sq += sq(q);
    }
    return nearest > 0 ? std::sqrt(outside_sq) : nearest;
  }

  Vec3 normal(const Vec3& p) const override {
    Vec3 away{};
    double nearest = -unbounded;
    Vec3 face = unit(0, 1);
    for (int k = 0; k < 3; ++k) {
      const double below = box_.lo[k] - p[k];
      const double above = p[k] - box_.hi[k];
      const double q = std::max(below, above);
      if (q > 0) away[k] = below > above ? -q : q;
      if (q > nearest) nearest = q, face = unit(k, below > above ? -1 : 1);
    }
    const double length = norm(away);
    return length > 0 ? away / length : face;
  }

  Bounds bounds() const override { return box_; }
  std::optional<Bounds> as_box() const override { return box_; }
  bool flat_parts(Side side, std::vector<FlatPart>& parts) const override {
    if (side == Side::inside) parts.emplace_back();
    for (int k = 0; k < 3; ++k)
      for (const int end : {0, 1}) {
        FlatFace face{{}, unit(k, end == 0 ? -1 : 1)};
        face.point[k] = end == 0 ? box_.lo[k] : box_.hi[k];
        if (!std::isfinite(face.point[k])) continue;
        if (side == Side::inside) {
          parts.back().push_back(face);
        } else {
          parts.push_back({{face.point, -face.normal}});
        }
      }
    return true;
  }
  bool inside(const Vec3& p) const override { return box_.holds(p); }

  Spans spans(const Vec3& from, const Vec3& to) const override {
    Cut in{-unbounded, {}};
    Cut out{unbounded, {}};
    for (int k = 0; k < 3; ++k) {
      const double d = to[k] - from[k];
      if (d == 0) {
        if (!(from[k] > box_.lo[k] && from[k] < box_.hi[k])) return {};
        continue;
      }
      const double sign = d > 0 ? 1 : -1;
      const double enter = ((d > 0 ? box_.lo[k] : box_.hi[k]) - from[k]) / d;
      const double leave = ((d > 0 ? box_.hi[k] : box_.lo[k]) - from[k]) / d;
      if (enter > in.at) in = {enter, unit(k, -sign)};
      if (leave < out.at) out = {leave, unit(k, sign)};
    }
    return convex_spans(in, out);
  }

  bool clear(const Vec3& from, const Vec3& to, Side side) const override {
    return side == Side::inside ? box_.holds(from) && box_.holds(to) : box_.clear_of(from, to);
  }

 private:
  Bounds box_;
};

class Sphere final : public Shape {
 public:
  Sphere(const Vec3& centre, double radius) : centre_(centre), radius_(radius) {}

  double signed_distance(const Vec3& p) const override { return norm(p - centre_) - radius_; }

  Vec3 normal(const Vec3& p) const override {
    const Vec3 d = p - centre_;
    const double r = norm(d);
    return r > 0 ? d / r : unit(0, 1);
  }

  Bounds bounds() const override {
    const Vec3 r{{radius_, radius_, radius_}};
    return {centre_ - r, centre_ + r};
  }

  Spans spans(const Vec3& from, const Vec3& to) const override {
    const Vec3 m = from - centre_;
    const Vec3 d = to - from;
    double in = 0;
    double out = 0;
    if (!round_roots(m, d, radius_, in, out)) return {};
    const auto cut = [&](double t) { return Cut{t, normal(from + t * d)}; };
    return convex_spans(cut(in), cut(out));
  }

 private:
  Vec3 centre_;
  double radius_;
};

class Cylinder final : public Shape {
 public:
  Cylinder(const Vec3& from, const Vec3& to, double radius)
      : from_(from), axis_((to - from) / norm(to - from)), length_(norm(to - from)), radius_(radius) {}

  double signed_distance(const Vec3& p) const override {
    const auto [side, end, height] = gaps(p);
    return std::min(std::max(side, end), 0.0) + std::hypot(std::max(side, 0.0), std::max(end, 0.0));
  }

  Vec3 normal(const Vec3& p) const override {
    const auto [side, end, height] = gaps(p);
    const Vec3 up = height > 0.5 * length_ ? axis_ : -axis_;
    if (side <= 0 && end <= 0) return side > end ? radial(p) : up;
    const double s = std::max(side, 0.0);
    const double e = std::max(end, 0.0);
    const Vec3 n = s * radial(p) + e * up;
    return n / norm(n);
  }

  Bounds bounds() const override {
    Bounds box;
    for (int k = 0; k < 3; ++k) {
      const double reach = radius_ * std::sqrt(std::max(0.0, 1 - sq(axis_[k])));
      const double other = from_[k] + length_ * axis_[k];
      box.lo[k] = std::min(from_[k], other) - reach;
      box.hi[k] = std::max(from_[k], other) + reach;
    }
    return box;
  }

  Spans spans(const Vec3& from, const Vec3& to) const override {
    const Vec3 m = from - from_;
    const Vec3 d = to - from;
    const double h = dot(m, axis_);
    const double dh = dot(d, axis_);
    const Vec3 across = m - h * axis_;
    const Vec3 d_across = d - dh * axis_;
    Cut in{-unbounded, {}};
    Cut out{unbounded, {}};
    if (norm_sq(d_across) > 1e-30 * norm_sq(d)) {
      if (!round_roots(across, d_across, radius_, in.at, out.at)) return {};
      in.normal = radial(from + in.at * d);
      out.normal = radial(from + out.at * d);
    } else if (norm(across) >= radius_) {
      return {};
    }
    if (dh == 0) return h > 0 && h < length_ ? convex_spans(in, out) : Spans{};
    const double enter = ((dh > 0 ? 0.0 : length_) - h) / dh;
    const double leave = ((dh > 0 ? length_ : 0.0) - h) / dh;
    const Vec3 ahead = dh > 0 ? axis_ : -axis_;
    if (enter > in.at) in = {enter, -ahead};
    if (leave < out.at) out = {leave, ahead};
    return convex_spans(in, out);
  }

 private:
  struct Gaps {
    double side, end, height;
  };
  Gaps gaps(const Vec3& p) const {
    const double h = dot(p - from_, axis_);
    return {norm(p - from_ - h * axis_) - radius_, std::max(-h, h - length_), h};
  }
  Vec3 radial(const Vec3& p) const {
    const Vec3 m = p - from_;
    Vec3 r = m - dot(m, axis_) * axis_;
    if (norm(r) == 0) r = cross(axis_, std::abs(axis_[0]) < 0.9 ? unit(0, 1) : unit(1, 1));
    return r / norm(r);
  }

  Vec3 from_, axis_;
  double length_, radius_;
};

class HalfSpace final : public Shape {
 public:
  HalfSpace(const Vec3& point, const Vec3& n) : normal_(n), offset_(dot(point, n)) {}

  double signed_distance(const Vec3& p) const override { return dot(p, normal_) - offset_; }
  Vec3 normal(const Vec3&) const override { return normal_; }

  Bounds bounds() const override {
    Bounds box = Bounds::everything();
    for (int k = 0; k < 3; ++k) {
      if (normal_[k] == 1) box.hi[k] = offset_;
      if (normal_[k] == -1) box.lo[k] = -offset_;
    }
    return box;
  }

  Spans spans(const Vec3& from, const Vec3& to) const override {
    const double a = signed_distance(from);
    const double slope = dot(to - from, normal_);
    if (slope == 0) return a < 0 ? convex_spans({-unbounded, {}}, {unbounded, {}}) : Spans{};
    const Cut cut{-a / slope, normal_};
    return slope > 0 ? convex_spans({-unbounded, {}}, cut) : convex_spans(cut, {unbounded, {}});
  }

  bool clear(const Vec3& from, const Vec3& to, Side side) const override {
    const double a = signed_distance(from);
    const double b = signed_distance(to);
    return side == Side::inside ? a < 0 && b < 0 : a > 0 && b > 0;
  }

  bool flat_parts(Side side, std::vector<FlatPart>& parts) const override {
    parts.push_back({{offset_ * normal_, side == Side::inside ? normal_ : -normal_}});
    return true;
  }

 private:
  Vec3 normal_;
  double offset_;
};

}  // namespace

ShapePtr make_box(const Vec3& lo, const Vec3& hi, int dimensions) {
  if (dimensions < 1 || dimensions > 3) {
    throw InputError({.what = "a box has 1, 2 or 3 dimensions", .why = fmt::format("{} were asked for", dimensions)});
  }
  Bounds box = Bounds::everything();
  for (int k = 0; k < dimensions; ++k) {
    if (!(lo[k] < hi[k])) {
      throw InputError({.what = "a box needs its lower corner below its upper one",
                        .why = fmt::format("along {} it goes from {} to {}", "xyz"[k], lo[k], hi[k]),
                        .fix = "swap or correct the two corners"});
    }
    box.lo[k] = lo[k];
    box.hi[k] = hi[k];
  }
  return std::make_shared<BoxShape>(box);
}

ShapePtr make_sphere(const Vec3& centre, double radius) {
  require_finite(centre, "the centre of the sphere");
  require_radius(radius, "sphere");
  return std::make_shared<Sphere>(centre, radius);
}

ShapePtr make_cylinder(const Vec3& from, const Vec3& to, double radius) {
  require_finite(from, "an end point of the cylinder");
  require_finite(to, "an end point of the cylinder");
  require_radius(radius, "cylinder");
  if (!(norm(to - from) > 0)) {
    throw InputError({.what = "a cylinder needs two different end points",
                      .why = fmt::format("both are ({}, {}, {})", from[0], from[1], from[2])});
  }
  return std::make_shared<Cylinder>(from, to, radius);
}

ShapePtr make_half_space(const Vec3& point, const Vec3& outward_normal) {
  require_finite(point, "the point of the half-space");
  require_finite(outward_normal, "the normal of the half-space");
  const double length = norm(outward_normal);
  if (!(length > 0)) throw InputError({.what = "a half-space needs a normal", .why = "the one given has length 0"});
  return std::make_shared<HalfSpace>(point, outward_normal / length);
}

}  // namespace undine
