// The region inside a triangle mesh.
#include <cmath>
#include <mutex>
#include <utility>

#include "undine/core/error.hpp"
#include "undine/geometry/bvh.hpp"

namespace undine {
namespace {

/// A coarse grid of distances, so that a short segment far from the mesh is passed without asking the tree.
class ClearanceGrid {
 public:
  explicit ClearanceGrid(const Bvh& tree) : lo_(tree.bounds().lo) {
    const Vec3 size = tree.bounds().hi - lo_;
    cell_ = std::max({size[0], size[1], size[2]}) / most_cells;
    const Vec3 half{{0.5 * cell_, 0.5 * cell_, 0.5 * cell_}};
    for (int k = 0; k < 3; ++k) count_[k] = std::max(1, static_cast<int>(std::ceil(size[k] / cell_)));
    for (int z = 0; z < count_[2]; ++z) {
      for (int y = 0; y < count_[1]; ++y) {
        for (int x = 0; x < count_[0]; ++x) {
          const double d = tree.signed_distance(lo_ + cell_ * Vec3{{1.0 * x, 1.0 * y, 1.0 * z}} + half);
          // Any point of the cell is at least this far away, less a part in 1e6 for the rounding to float.
          const double sure = std::max(0.0, std::abs(d) - 1.000001 * norm(half)) * (1 - 1e-6);
          room_.push_back(static_cast<float>(d < 0 ? -sure : sure));
        }
      }
    }
  }

  /// A lower bound of the distance from p to the mesh, negative inside; 0 when nothing is known.
  double room(const Vec3& p) const {
    int at[3];
    for (int k = 0; k < 3; ++k) {
      const double x = (p[k] - lo_[k]) / cell_;
      if (!(x >= 0 && x < count_[k])) return 0;
      at[k] = static_cast<int>(x);
    }
    return room_[static_cast<std::size_t>((at[2] * count_[1] + at[1]) * count_[0] + at[0])];
  }

 private:
  static constexpr int most_cells = 32;
  Vec3 lo_;
  double cell_ = 1;
  int count_[3] = {1, 1, 1};
  std::vector<float> room_;
};

class MeshShape final : public Shape {
 public:
  explicit MeshShape(TriangleMesh mesh) : tree_(std::move(mesh)) {}

  double signed_distance(const Vec3& p) const override { return tree_.signed_distance(p); }

  Vec3 normal(const Vec3& p) const override {
    const Closest near = tree_.closest(p);
    const Vec3 away = p - near.point;
    const bool close = near.distance <= 1e-9 * tree_.bounds().scale();
    const Vec3 n = close ? near.normal : dot(away, near.normal) < 0 ? -away : away;
    return n / norm(n);
  }

  Bounds bounds() const override { return tree_.bounds(); }
  bool inside(const Vec3& p) const override { return tree_.inside(p); }

  Spans spans(const Vec3& from, const Vec3& to) const override {
    const auto in = [&](double t) { return tree_.inside(from + t * (to - from)); };
    return spans_from_cuts(tree_.all_hits(from, to), to - from, in);
  }

  std::optional<Crossing> first_crossing(const Vec3& from, const Vec3& to, Side side) const override {
    const auto hit = tree_.first_hit(from, to, side == Side::inside ? Facing::leaving : Facing::entering);
    if (!hit) return std::nullopt;
    return Crossing{hit->fraction, hit->point, hit->normal};
  }

  bool clear(const Vec3& from, const Vec3& to, Side side) const override {
    if (side == Side::outside && tree_.bounds().clear_of(from, to)) return true;
    std::call_once(once_, [this] { grid_ = std::make_unique<ClearanceGrid>(tree_); });
    double room = grid_->room(from);
    if (room == 0) room = tree_.signed_distance(from);
    const double depth = side == Side::inside ? -room : room;
    // The ray goes on a little beyond the end, so that an end within rounding of the surface does not pass.
    if (!(depth > 1e-9 * tree_.bounds().scale())) return false;
    return sq(depth) > norm_sq(to - from) * (1 + 1e-12) || !tree_.first_hit(from, to + 1e-6 * (to - from));
  }

 private:
  Bvh tree_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<ClearanceGrid> grid_;
};

}  // namespace

ShapePtr make_mesh(TriangleMesh mesh) {
  check_watertight(mesh);
  orient_outward(mesh);
  return std::make_shared<MeshShape>(std::move(mesh));
}

}  // namespace undine
