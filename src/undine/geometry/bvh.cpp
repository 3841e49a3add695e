#include "undine/geometry/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace undine {
namespace {

constexpr int leaf_size = 4;
constexpr int stack_size = 64;

double distance_sq(const Bounds& box, const Vec3& p) {
  double d = 0;
  for (int k = 0; k < 3; ++k) d += sq(std::max({box.lo[k] - p[k], p[k] - box.hi[k], 0.0}));
  return d;
}

}  // namespace

/// A ray prepared for the watertight test of Woop, Benthin and Wald (2013).
struct Bvh::Ray {
  Ray(const Vec3& from, const Vec3& to) : origin(from), d(to - from) {
    kz = std::abs(d[0]) > std::abs(d[1]) ? 0 : 1;
    if (std::abs(d[2]) > std::abs(d[kz])) kz = 2;
    kx = (kz + 1) % 3;
    ky = (kz + 2) % 3;
    if (d[kz] < 0) std::swap(kx, ky);
    sx = d[kx] / d[kz];
    sy = d[ky] / d[kz];
    sz = 1 / d[kz];
  }

  bool meets(const Bounds& box, double limit) const {
    double begin = 0;
    double end = limit;
    for (int k = 0; k < 3; ++k) {
      if (d[k] == 0) {
        if (origin[k] < box.lo[k] || origin[k] > box.hi[k]) return false;
        continue;
      }
      const double a = (box.lo[k] - origin[k]) / d[k];
      const double b = (box.hi[k] - origin[k]) / d[k];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    return begin <= end;
  }

  Vec3 origin, d;
  int kx, ky, kz;
  double sx, sy, sz;
};

/// How a ray meets the plane of a triangle.
struct Bvh::Touch {
  bool hit = false;
  bool doubtful = false;  ///< so near an edge, or so flat, that rounding decides
  double fraction = 0;
};

Bvh::Bvh(TriangleMesh mesh) : mesh_(std::move(mesh)), order_(mesh_.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vec3> centres;
  for (const auto& t : mesh_.triangles) {
    centres.push_back((mesh_.vertices[t[0]] + mesh_.vertices[t[1]] + mesh_.vertices[t[2]]) / 3.0);
  }
  nodes_.reserve(2 * order_.size() / leaf_size + 2);
  build(0, static_cast<int>(order_.size()), centres, 1e-12 * bounds_of(mesh_).scale());
  find_pseudo_normals();
}

int Bvh::build(int first, int count, std::vector<Vec3>& centres, double margin) {
  const int here = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, first, count, 0});
  Bounds box;
  Bounds middle;
  for (int i = first; i < first + count; ++i) {
    for (const int v : mesh_.triangles[order_[i]]) box.include(mesh_.vertices[v]);
    middle.include(centres[order_[i]]);
  }
  for (int k = 0; k < 3; ++k) box.lo[k] -= margin, box.hi[k] += margin;
  nodes_[here].box = box;
  if (count <= leaf_size) return here;
  int axis = 0;
  for (int k = 1; k < 3; ++k) {
    if (middle.hi[k] - middle.lo[k] > middle.hi[axis] - middle.lo[axis]) axis = k;
  }
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](int a, int b) { return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b); });
  const int left = build(first, count / 2, centres, margin);
  const int right = build(first + count / 2, count - count / 2, centres, margin);
  nodes_[here].first = left;
  nodes_[here].count = 0;
  nodes_[here].right = right;
  return here;
}

void Bvh::find_pseudo_normals() {
  vertex_normals_.assign(mesh_.vertices.size(), Vec3{});
  std::map<std::pair<int, int>, Vec3> edges;
  const auto key = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
  for (const auto& t : mesh_.triangles) {
    std::array<Vec3, 3> p{mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]};
    Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    const double length = norm(n);
    if (length > 0) n = n / length;
    face_normals_.push_back(n);
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = p[(k + 1) % 3] - p[k];
      const Vec3 b = p[(k + 2) % 3] - p[k];
      vertex_normals_[t[k]] += std::atan2(norm(cross(a, b)), dot(a, b)) * n;
      edges[key(t[k], t[(k + 1) % 3])] += n;
    }
  }
  for (const auto& t : mesh_.triangles) {
    edge_normals_.push_back({edges[key(t[0], t[1])], edges[key(t[1], t[2])], edges[key(t[2], t[0])]});
  }
}

Bvh::Touch Bvh::meet(const Ray& ray, int triangle) const {
  std::array<double, 3> x, y, z;
  for (int c = 0; c < 3; ++c) {
    const Vec3 p = mesh_.vertices[mesh_.triangles[triangle][c]] - ray.origin;
    x[c] = p[ray.kx] - ray.sx * p[ray.kz];
    y[c] = p[ray.ky] - ray.sy * p[ray.kz];
    z[c] = ray.sz * p[ray.kz];
  }
  // Edge functions; within rounding of 0 the ray counts as hitting, for both triangles of the edge.
  std::array<double, 3> u;
  bool above = false;
  bool below = false;
  Touch touch;
  double det = 0;
  double size = 0;
  for (int c = 0; c < 3; ++c) {
    const int a = (c + 2) % 3;
    const int b = (c + 1) % 3;
    const double p = x[a] * y[b];
    const double q = y[a] * x[b];
    const double rounding = std::abs(p) + std::abs(q);
    u[c] = p - q;
    above |= u[c] > 1e-15 * rounding;
    below |= u[c] < -1e-15 * rounding;
    touch.doubtful |= std::abs(u[c]) <= 1e-11 * rounding;
    det += u[c];
    size += rounding;
  }
  if (above && below) return {};
  if (std::abs(det) <= 1e-15 * size) return {false, true, 0};
  touch.fraction = (u[0] * z[0] + u[1] * z[1] + u[2] * z[2]) / det;
  touch.hit = touch.fraction >= 0 && touch.fraction <= 1;
  touch.doubtful |= std::abs(touch.fraction) < 1e-14;
  return touch;
}

template <class Visit>
void Bvh::along(const Ray& ray, double& limit, Visit visit) const {
  std::array<int, stack_size> stack;
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    if (!ray.meets(node.box, limit)) continue;
    if (node.count == 0) {
      stack[top++] = node.right;
      stack[top++] = node.first;
    }
    for (int i = node.first; i < node.first + node.count; ++i) visit(order_[i], meet(ray, order_[i]));
  }
}

std::optional<Hit> Bvh::first_hit(const Vec3& from, const Vec3& to, Facing facing) const {
  if (from == to) return std::nullopt;
  const Ray ray(from, to);
  Hit best;
  double limit = 1;
  double best_slope = 0;
  along(ray, limit, [&](int triangle, const Touch& touch) {
    if (!touch.hit || touch.fraction > limit) return;
    const double slope = dot(face_normals_[triangle], ray.d);
    if ((facing == Facing::entering && slope >= 0) || (facing == Facing::leaving && slope <= 0)) return;
    // Of two triangles met at their common edge, the one faced more squarely; so the answer has no order in it.
    if (touch.fraction == limit && best.triangle >= 0 &&
        std::pair(std::abs(slope), -triangle) < std::pair(best_slope, -best.triangle)) {
      return;
    }
    limit = touch.fraction;
    best_slope = std::abs(slope);
    best = {limit, from + limit * ray.d, slope > 0 ? -face_normals_[triangle] : face_normals_[triangle], triangle};
  });
  return best.triangle < 0 ? std::nullopt : std::optional(best);
}

std::vector<Cut> Bvh::all_hits(const Vec3& from, const Vec3& to) const {
  std::vector<Cut> cuts;
  if (from == to) return cuts;
  double limit = 1;
  along(Ray(from, to), limit, [&](int triangle, const Touch& touch) {
    if (touch.hit) cuts.push_back({touch.fraction, face_normals_[triangle]});
  });
  return cuts;
}

bool Bvh::inside(const Vec3& p) const {
  static constexpr std::array<Vec3, 6> directions{{{{0.8191, 0.4713, 0.3271}},
                                                   {{-0.3541, 0.7919, 0.4973}},
                                                   {{0.2917, -0.3877, 0.8744}},
                                                   {{-0.6173, -0.5591, -0.5533}},
                                                   {{0.1373, 0.5821, -0.8014}},
                                                   {{0.6911, -0.7027, 0.1693}}}};
  const Bounds& box = bounds();
  if (!box.holds(p)) return false;
  const double reach = 2.5 * norm(box.hi - box.lo);
  for (const Vec3& direction : directions) {
    int hits = 0;
    bool doubtful = false;
    double limit = 1;
    along(Ray(p, p + reach * direction), limit, [&](int, const Touch& touch) {
      hits += touch.hit;
      doubtful |= touch.doubtful;
    });
    if (!doubtful) return hits % 2 == 1;
  }
  return signed_distance(p) < 0;
}

// Ericson, Real-Time Collision Detection (2005), section 5.1.5.
Closest Bvh::closest_on(int triangle, const Vec3& p) const {
  const auto& t = mesh_.triangles[triangle];
  const Vec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp), d5 = dot(ab, cp),
               d6 = dot(ac, cp);
  const auto answer = [&](const Vec3& q, const Vec3& n) { return Closest{q, norm(p - q), n, triangle}; };
  if (d1 <= 0 && d2 <= 0) return answer(a, vertex_normals_[t[0]]);
  if (d3 >= 0 && d4 <= d3) return answer(b, vertex_normals_[t[1]]);
  if (d6 >= 0 && d5 <= d6) return answer(c, vertex_normals_[t[2]]);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return answer(a + d1 / (d1 - d3) * ab, edge_normals_[triangle][0]);
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return answer(a + d2 / (d2 - d6) * ac, edge_normals_[triangle][2]);
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return answer(b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b), edge_normals_[triangle][1]);
  }
  // Over the face: along the normal, which keeps the sign of tiny distances.
  const Vec3& n = face_normals_[triangle];
  const double height = dot(n, ap);
  return {p - height * n, std::abs(height), n, triangle};
}

Closest Bvh::closest(const Vec3& p) const {
  Closest best;
  std::array<std::pair<double, int>, stack_size> stack;
  int top = 0;
  stack[top++] = {distance_sq(nodes_[0].box, p), 0};
  while (top > 0) {
    const auto [gap, index] = stack[--top];
    if (gap > sq(best.distance)) continue;
    const Node& node = nodes_[index];
    for (int i = node.first; i < node.first + node.count; ++i) {
      const Closest found = closest_on(order_[i], p);
      if (found.distance < best.distance) best = found;
    }
    if (node.count > 0) continue;
    std::pair<double, int> near{distance_sq(nodes_[node.first].box, p), node.first};
    std::pair<double, int> far{distance_sq(nodes_[node.right].box, p), node.right};
    if (near.first > far.first) std::swap(near, far);
    stack[top++] = far;
    stack[top++] = near;
  }
  return best;
}

double Bvh::signed_distance(const Vec3& p) const {
  const Closest near = closest(p);
  return dot(p - near.point, near.normal) < 0 ? -near.distance : near.distance;
}

}  // namespace undine
