// Union, intersection and difference: distances by minimum and maximum, crossings by interval arithmetic.
#include <algorithm>
#include <utility>

#include "undine/core/error.hpp"
#include "undine/geometry/shape.hpp"

namespace undine {
namespace {

/// The fraction of the segment below which a stretch is a rounding error: 1e-14 of the coordinates' size.
double thin_fraction(const Vec3& from, const Vec3& to) {
  double size = 0;
  for (int k = 0; k < 3; ++k) size = std::max({size, std::abs(from[k]), std::abs(to[k])});
  const double length = norm(to - from);
  return length > 0 ? std::min(1.0, 1e-14 * size / length) : 0.0;
}

/// What fills any of the shapes' sides.
bool flat_parts_of_any(const std::vector<ShapePtr>& shapes, Side side, std::vector<FlatPart>& parts) {
  return std::all_of(shapes.begin(), shapes.end(), [&](const auto& shape) { return shape->flat_parts(side, parts); });
}

/// What fills all of the shapes' sides, where each of these is a single convex region.
bool flat_part_of_all(const std::vector<ShapePtr>& shapes, Side side, std::vector<FlatPart>& parts) {
  FlatPart common;
  for (const auto& shape : shapes) {
    std::vector<FlatPart> one;
    if (!shape->flat_parts(side, one) || one.size() != 1) return false;
    common.insert(common.end(), one.front().begin(), one.front().end());
  }
  parts.push_back(std::move(common));
  return true;
}

/// Every point that is not in the shape.
class Complement final : public Shape {
 public:
  explicit Complement(ShapePtr shape) : shape_(std::move(shape)) {}

  double signed_distance(const Vec3& p) const override { return -shape_->signed_distance(p); }
  Vec3 normal(const Vec3& p) const override { return -shape_->normal(p); }
  Bounds bounds() const override { return Bounds::everything(); }
  bool inside(const Vec3& p) const override { return !shape_->inside(p); }
  Spans spans(const Vec3& from, const Vec3& to) const override {
    return other_spans(shape_->spans(from, to), thin_fraction(from, to));
  }
  bool flat_parts(Side side, std::vector<FlatPart>& parts) const override {
    return shape_->flat_parts(side == Side::inside ? Side::outside : Side::inside, parts);
  }

 private:
  ShapePtr shape_;
};

class Intersection final : public Shape {
 public:
  explicit Intersection(std::vector<ShapePtr> parts) : parts_(std::move(parts)) {
    bounds_ = Bounds::everything();
    for (const auto& part : parts_) bounds_ = overlap(bounds_, part->bounds());
  }

  double signed_distance(const Vec3& p) const override { return farthest(p).second; }
  Vec3 normal(const Vec3& p) const override { return farthest(p).first->normal(p); }
  Bounds bounds() const override { return bounds_; }
  bool inside(const Vec3& p) const override {
    return std::all_of(parts_.begin(), parts_.end(), [&](const auto& part) { return part->inside(p); });
  }
  Spans spans(const Vec3& from, const Vec3& to) const override {
    Spans all = parts_.front()->spans(from, to);
    const double thin = thin_fraction(from, to);
    for (std::size_t k = 1; k < parts_.size(); ++k) all = both_spans(all, parts_[k]->spans(from, to), thin);
    return all;
  }
  bool flat_parts(Side side, std::vector<FlatPart>& parts) const override {
    return side == Side::inside ? flat_part_of_all(parts_, side, parts) : flat_parts_of_any(parts_, side, parts);
  }

 private:
  std::pair<const Shape*, double> farthest(const Vec3& p) const {
    std::pair<const Shape*, double> best{nullptr, -unbounded};
    for (const auto& part : parts_) {
      const double d = part->signed_distance(p);
      if (!best.first || d > best.second) best = {part.get(), d};
    }
    return best;
  }

  std::vector<ShapePtr> parts_;
  Bounds bounds_;
};

class Union final : public Shape {
 public:
  explicit Union(std::vector<ShapePtr> parts) : parts_(std::move(parts)) {
    for (const auto& part : parts_) bounds_.include(part->bounds());
  }

  double signed_distance(const Vec3& p) const override { return nearest(p).second; }
  Vec3 normal(const Vec3& p) const override { return nearest(p).first->normal(p); }
  Bounds bounds() const override { return bounds_; }
  bool inside(const Vec3& p) const override {
    return std::any_of(parts_.begin(), parts_.end(), [&](const auto& part) { return part->inside(p); });
  }
  Spans spans(const Vec3& from, const Vec3& to) const override {
    const double thin = thin_fraction(from, to);
    Spans none = other_spans(parts_.front()->spans(from, to), thin);
    for (std::size_t k = 1; k < parts_.size(); ++k) {
      none = both_spans(none, other_spans(parts_[k]->spans(from, to), thin), thin);
    }
    return other_spans(none, 0);
  }
  bool flat_parts(Side side, std::vector<FlatPart>& parts) const override {
    return side == Side::inside ? flat_parts_of_any(parts_, side, parts) : flat_part_of_all(parts_, side, parts);
  }

 private:
  std::pair<const Shape*, double> nearest(const Vec3& p) const {
    std::pair<const Shape*, double> best{nullptr, unbounded};
    for (const auto& part : parts_) {
      const double d = part->signed_distance(p);
      if (!best.first || d < best.second) best = {part.get(), d};
    }
    return best;
  }

  std::vector<ShapePtr> parts_;
  Bounds bounds_;
};

void require_parts(const std::vector<ShapePtr>& parts, const char* what) {
  if (parts.empty()) throw InputError({.what = what, .why = "none was given", .fix = "name at least one shape"});
  for (const auto& part : parts) {
    if (!part) throw InputError({.what = what, .why = "one of them is missing"});
  }
}

}  // namespace

ShapePtr make_union(std::vector<ShapePtr> parts) {
  require_parts(parts, "a union needs shapes");
  if (parts.size() == 1) return parts.front();
  return std::make_shared<Union>(std::move(parts));
}

ShapePtr make_intersection(std::vector<ShapePtr> parts) {
  require_parts(parts, "an intersection needs shapes");
  if (parts.size() == 1) return parts.front();
  return std::make_shared<Intersection>(std::move(parts));
}

ShapePtr make_difference(ShapePtr whole, ShapePtr hole) {
  require_parts({whole, hole}, "a difference needs two shapes");
  return make_intersection({std::move(whole), std::make_shared<Complement>(std::move(hole))});
}

}  // namespace undine
