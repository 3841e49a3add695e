#pragma once
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <rapidcheck.h>
#include <unistd.h>

#include "undine/core/error.hpp"
#include "undine/geometry/mesh.hpp"

namespace undine::sample {

/// Any of 0..count-1, from the first test on (RapidCheck's own ranges start narrow).
inline int index(int count) { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, count)); }

/// A random number in [lo, hi]: one in eight is a round one (faces, edges, middles).
inline double number(double lo, double hi) {
  const double part = index(8) == 0 ? index(11) / 10.0 : index(1'000'000'001) / 1e9;
  return lo + (hi - lo) * part;
}
inline Vec3 point(double lo, double hi) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) p[k] = number(lo, hi);
  return p;
}

inline Vec3 rotated(const Vec3& p) {
  const double a = 0.4, b = 0.9;
  const Vec3 q{{std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]}};
  return {{q[0], std::cos(b) * q[1] - std::sin(b) * q[2], std::sin(b) * q[1] + std::cos(b) * q[2]}};
}

inline TriangleMesh map_points(TriangleMesh mesh, Vec3 (*f)(const Vec3&)) {
  for (Vec3& v : mesh.vertices) v = f(v);
  return mesh;
}

/// A right prism over a polygon given as a fan of triangles from its first corner (anticlockwise), z from 0 to 1.
inline TriangleMesh prism(const std::vector<std::array<double, 2>>& corners) {
  TriangleMesh mesh;
  const int n = static_cast<int>(corners.size());
  for (const double z : {0.0, 1.0}) {
    for (const auto& c : corners) mesh.vertices.push_back({{c[0], c[1], z}});
  }
  for (int i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back({0, i + 1, i});
    mesh.triangles.push_back({n, n + i, n + i + 1});
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
  }
  return mesh;
}

inline TriangleMesh cube() { return prism({{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}}); }

/// An L of three unit squares, from its inner corner (1, 1), which sees all of it.
inline TriangleMesh ell() { return prism({{{1, 1}}, {{1, 2}}, {{0, 2}}, {{0, 0}}, {{2, 0}}, {{2, 1}}}); }

/// A sphere of radius 1 about 0 from an octahedron, each triangle cut in four `levels` times.
inline TriangleMesh ball(int levels) {
  TriangleMesh mesh;
  mesh.vertices = {{{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (fresh) {
        const Vec3 m = mesh.vertices[a] + mesh.vertices[b];
        mesh.vertices.push_back(m / norm(m));
      }
      return it->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& t : mesh.triangles) {
      const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    mesh.triangles = finer;
  }
  return mesh;
}

/// A file of this process in the system's temporary directory, removed at the end.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("undine-" + std::to_string(::getpid()) + "-" + name)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code code;
    std::filesystem::remove(path_, code);
  }
  std::string path() const { return path_.string(); }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

 private:
  std::filesystem::path path_;
};

/// The text of the InputError that `action` throws; empty if it throws none.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace undine::sample
