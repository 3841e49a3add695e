#include "undine/geometry/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0;
    for (const auto x : c) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
    return h;
  }
};

/// A directed use of an edge by a triangle; `low` and `high` are its vertices in order of index.
struct EdgeUse {
  int low, high;
  bool forward;  ///< the triangle runs from low to high
};

std::vector<EdgeUse> sorted_edges(const TriangleMesh& mesh) {
  std::vector<EdgeUse> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const EdgeUse& a, const EdgeUse& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  return edges;
}

std::string place(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

/// Join open edges (from vertex to vertex) into the rims of holes.
std::vector<std::vector<int>> rims_of(std::multimap<int, int> open) {
  std::vector<std::vector<int>> rims;
  while (!open.empty()) {
    std::vector<int> rim{open.begin()->first};
    for (auto it = open.begin(); it != open.end(); it = open.find(rim.back())) {
      rim.push_back(it->second);
      open.erase(it);
    }
    if (rim.size() > 1 && rim.front() == rim.back()) rim.pop_back();
    rims.push_back(std::move(rim));
  }
  return rims;
}

std::string describe_rims(const TriangleMesh& mesh, const std::vector<std::vector<int>>& rims) {
  std::string text;
  for (std::size_t r = 0; r < std::min<std::size_t>(rims.size(), 3); ++r) {
    text += fmt::format("{}hole {} has its rim at", r ? "; " : "", r + 1);
    const std::size_t shown = std::min<std::size_t>(rims[r].size(), 4);
    for (std::size_t k = 0; k < shown; ++k) text += " " + place(mesh.vertices[rims[r][k]]);
    if (shown < rims[r].size()) text += fmt::format(" and {} more", rims[r].size() - shown);
  }
  if (rims.size() > 3) text += fmt::format("; and {} holes more", rims.size() - 3);
  return text;
}

}  // namespace

Bounds bounds_of(const TriangleMesh& mesh) {
  Bounds box;
  for (const Vec3& v : mesh.vertices) box.include(v);
  return box;
}

TriangleMesh weld(const TriangleMesh& mesh, double tolerance) {
  TriangleMesh out;
  out.source = mesh.source;
  if (mesh.vertices.empty()) return out;
  const Bounds box = bounds_of(mesh);
  const double reach = std::max({tolerance * norm(box.hi - box.lo), 1e-15 * box.scale(), 1e-300});
  std::unordered_map<Cell, std::vector<int>, CellHash> cells;
  std::vector<int> where(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    Cell home;
    for (int k = 0; k < 3; ++k) home[k] = static_cast<std::int64_t>(std::floor((v[k] - box.lo[k]) / reach));
    int found = -1;
    for (int n = 0; n < 27 && found < 0; ++n) {
      const auto it = cells.find({home[0] + n % 3 - 1, home[1] + n / 3 % 3 - 1, home[2] + n / 9 - 1});
      if (it == cells.end()) continue;
      for (const int j : it->second) {
        if (norm(out.vertices[j] - v) <= reach) found = j;
      }
    }
    if (found < 0) {
      found = static_cast<int>(out.vertices.size());
      out.vertices.push_back(v);
      cells[home].push_back(found);
    }
    where[i] = found;
  }
  for (const auto& t : mesh.triangles) {
    const std::array<int, 3> n{where[t[0]], where[t[1]], where[t[2]]};
    if (n[0] != n[1] && n[1] != n[2] && n[2] != n[0]) out.triangles.push_back(n);
  }
  return out;
}

void check_watertight(const TriangleMesh& mesh) {
  const auto edges = sorted_edges(mesh);
  std::multimap<int, int> open;
  std::vector<EdgeUse> crowded;
  std::vector<EdgeUse> disagreeing;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    const EdgeUse& e = edges[i];
    if (end - i == 1) open.emplace(e.forward ? e.high : e.low, e.forward ? e.low : e.high);
    if (end - i == 2 && e.forward == edges[i + 1].forward) disagreeing.push_back(e);
    if (end - i > 2) crowded.push_back(e);
    i = end;
  }
  if (mesh.triangles.size() >= 4 && open.empty() && crowded.empty() && disagreeing.empty()) return;
  std::string why;
  const auto say = [&](const std::string& text) { why += (why.empty() ? "" : "; ") + text; };
  const auto first_place = [&](const std::vector<EdgeUse>& list) {
    return "the first from " + place(mesh.vertices[list[0].low]) + " to " + place(mesh.vertices[list[0].high]);
  };
  if (!open.empty()) {
    const auto rims = rims_of(open);
    say(fmt::format("{} open edges around {} {}: {}", open.size(), rims.size(), rims.size() == 1 ? "hole" : "holes",
                    describe_rims(mesh, rims)));
  }
  if (!crowded.empty()) {
    say(fmt::format("{} edges join more than two triangles, {}", crowded.size(), first_place(crowded)));
  }
  if (!disagreeing.empty()) {
    say(fmt::format("{} edges join triangles that face opposite ways, {}", disagreeing.size(),
                    first_place(disagreeing)));
  }
  if (why.empty()) say(fmt::format("it has {} triangles; 4 is the least for a body", mesh.triangles.size()));
  throw InputError({.what = "the mesh is not watertight",
                    .where = {.file = mesh.source},
                    .why = why,
                    .fix = "close the holes and unify the normals in the program that made the mesh"});
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  const Vec3 base = mesh.vertices[0];
  double volume = 0;
  for (const auto& t : mesh.triangles) {
    volume += dot(mesh.vertices[t[0]] - base, cross(mesh.vertices[t[1]] - base, mesh.vertices[t[2]] - base)) / 6;
  }
  return volume;
}

void orient_outward(TriangleMesh& mesh) {
  if (signed_volume(mesh) >= 0) return;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace undine
