#include "undine/walls/mirrors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "undine/core/error.hpp"

namespace undine::walls {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int no_solid = -1;

/// The mirror where planes meet, by Gram and Schmidt; none where their normals do not span a space of their number.
template <int N>
bool orthonormalise(Mirror<N>& mirror, const std::array<Plane<N>, N>& planes) {
  for (int k = 0; k < mirror.count; ++k) {
    Vec<N> axis = planes[k].normal;
    double offset = planes[k].offset;
    for (int j = 0; j < k; ++j) {
      const double along = dot(planes[k].normal, mirror.axes[j]);
      axis -= along * mirror.axes[j];
      offset -= along * mirror.offsets[j];
    }
    const double length = norm(axis);
    if (length < 1e-4) return false;
    mirror.axes[k] = axis / length;
    mirror.offsets[k] = offset / length;
  }
  return true;
}

/// Whether d = sum_k alpha_k n_k with all alpha_k >= 0: then c, with d = x - c, is the nearest point of the fluid to
/// the place 2 c - x. Always so where the normals are at right angles.
template <int N>
bool in_cone(const Vec<N>& d, const std::array<Vec<N>, N>& normals, int count) {
  double matrix[N][N + 1];
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) matrix[i][j] = dot(normals[i], normals[j]);
    matrix[i][count] = dot(normals[i], d);
  }
  for (int i = 0; i < count; ++i)  // the matrix of inner products is positive definite: no pivots are needed
    for (int row = 0; row < count; ++row) {
      if (row == i) continue;
      const double factor = matrix[row][i] / matrix[i][i];
      for (int j = i; j <= count; ++j) matrix[row][j] -= factor * matrix[i][j];
    }
  for (int i = 0; i < count; ++i)
    if (matrix[i][count] / matrix[i][i] < 0) return false;
  return true;
}

/// The corners of a solid.
template <int N>
std::vector<Vec<N>> corners(const Solid<N>& solid, double tolerance) {
  std::vector<Vec<N>> found;
  const int count = static_cast<int>(solid.faces.size());
  std::array<int, N> chosen{};
  const auto choose = [&](auto&& self, int depth, int first) -> void {
    if (depth == N) {
      Mirror<N> corner{.count = N};
      std::array<Plane<N>, N> planes;
      for (int k = 0; k < N; ++k) planes[k] = solid.faces[chosen[k]];
      if (!orthonormalise<N>(corner, planes)) return;
      const Vec<N> at = corner.foot({});
      if (std::ranges::all_of(solid.faces, [&](const auto& face) { return face.height(at) <= tolerance; }))
        found.push_back(at);
      return;
    }
    for (int f = first; f < count; ++f) {
      chosen[depth] = f;
      self(self, depth + 1, f + 1);
    }
  };
  choose(choose, 0, 0);
  return found;
}

}  // namespace

template <int N>
Mirrors<N>::Mirrors(std::vector<Solid<N>> solids, Slip slip, double reach, const Domain<N>& domain)
    : solids_(std::move(solids)), slip_(slip), reach_(reach), tolerance_(1e-9 * reach) {
  repeat(domain);
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    first_face_.push_back(static_cast<int>(faces_.size()));
    for (const auto& face : solids_[s].faces) faces_.push_back({face, static_cast<int>(s)});
  }
  check_gaps();
  find_mirrors(domain);
}

/// Along a periodic axis a wall has no end, or lies within the period and is repeated on either side of it.
template <int N>
void Mirrors<N>::repeat(const Domain<N>& domain) {
  for (int k = 0; k < N; ++k) {
    if (!domain.periodic[k]) continue;
    std::vector<Solid<N>> all;
    for (auto& solid : solids_) {
      const auto across = [&](const Plane<N>& face) { return std::abs(face.normal[k]) > 1e-9; };
      if (std::ranges::none_of(solid.faces, across)) {
        all.push_back(solid);
        continue;
      }
      double low = infinity, high = -infinity;
      for (const auto& corner : corners(solid, tolerance_))
        low = std::min(low, corner[k]), high = std::max(high, corner[k]);
      if (!(high > low))
        throw InputError(
            {.what = fmt::format("the wall '{}' stands across the period along {}", solid.name, "xyz"[k]),
             .why = "its ghosts would lie in the fluid on the other side of the period",
             .fix = fmt::format("name its faces {0}- and {0}+ in 'open', or do not repeat space along {0}", "xyz"[k])});
      if (high - low > domain.length(k) - tolerance_) {
        std::erase_if(solid.faces, across);
        all.push_back(solid);
        continue;
      }
      for (const int shift : {0, -1, 1}) {
        all.push_back(solid);
        for (auto& face : all.back().faces) face.offset += shift * domain.length(k) * face.normal[k];
      }
    }
    solids_ = std::move(all);
  }
}

/// Walls nearer than the reach: fluid between them would see images of images, fluid behind a thin one the other side.
template <int N>
void Mirrors<N>::check_gaps() const {
  for (std::size_t a = 0; a < faces_.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const auto& [plane, solid] = faces_[a];
      const auto& [other, other_solid] = faces_[b];
      if (dot(plane.normal, other.normal) > -1 + 1e-9) continue;
      const bool half_spaces = solids_[solid].faces.size() == 1 && solids_[other_solid].faces.size() == 1;
      const double gap = -(plane.offset + other.offset);
      if (half_spaces && gap > 0 && gap < reach_)
        throw InputError({.what = fmt::format("ghosts need more room between walls: '{}' and '{}' are {:.4g} m apart",
                                              solids_[other_solid].name, solids_[solid].name, gap),
                          .why = fmt::format("fluid sees {:.4g} m far, and there would need images of images", reach_),
                          .fix = "widen the gap or lessen the spacing"});
      if (solid == other_solid && -gap < reach_ && exposed(solid, a - first_face_[solid]) &&
          exposed(solid, b - first_face_[solid]))
        throw InputError(
            {.what = fmt::format("the wall '{}' is {:.4g} m thick, too thin for ghosts", solids_[solid].name, -gap),
             .why = fmt::format("fluid sees {:.4g} m far: through the wall", reach_),
             .fix = "make it thicker, or lessen the spacing"});
    }
}

/// Whether fluid may touch a face, as far as its middle tells.
template <int N>
bool Mirrors<N>::exposed(int solid, std::size_t face) const {
  const auto& plane = solids_[solid].faces[face];
  Vec<N> middle{};
  double count = 0;
  for (const auto& corner : corners(solids_[solid], tolerance_))
    if (plane.height(corner) > -tolerance_) middle += corner, ++count;
  return count == 0 || !covered(middle / count + 10 * tolerance_ * plane.normal, solid);
}

template <int N>
bool Mirrors<N>::has(const Mirror<N>& mirror, int plane) const {
  return std::find(mirror.planes.begin(), mirror.planes.begin() + mirror.count, plane) !=
         mirror.planes.begin() + mirror.count;
}

/// All faces, then all edges, then all corners between different solids; the order is that of the walls in the case.
template <int N>
void Mirrors<N>::find_mirrors(const Domain<N>& domain) {
  const int count = static_cast<int>(faces_.size());
  std::vector<Mirror<N>> last(1);
  for (int order = 1; order <= N; ++order) {
    std::vector<Mirror<N>> next;
    for (const auto& base : last)
      for (int f = order > 1 ? base.planes[order - 2] + 1 : 0; f < count; ++f) {
        Mirror<N> mirror = base;
        mirror.planes[mirror.count++] = f;
        bool apart = true;
        std::array<Plane<N>, N> planes;
        for (int k = 0; k < order; ++k) {
          planes[k] = faces_[mirror.planes[k]].plane;
          for (int j = 0; j < k; ++j) apart = apart && faces_[mirror.planes[k]].solid != faces_[mirror.planes[j]].solid;
        }
        if (!apart || !orthonormalise<N>(mirror, planes) || !meet(mirror, domain)) continue;
        if (order == 2) {
          const auto& [a, b] = std::pair(faces_[mirror.planes[0]], faces_[mirror.planes[1]]);
          const double cosine = dot(a.plane.normal, b.plane.normal);
          if (cosine < -1e-6)
            throw InputError(
                {.what = fmt::format("the walls '{}' and '{}' meet at {:.3g} degrees, too sharp for ghosts",
                                     solids_[a.solid].name, solids_[b.solid].name,
                                     180 - std::acos(cosine) * 180 / std::numbers::pi),
                 .why = "below 90 degrees the images of the fluid leave a part of the edge empty",
                 .fix =
                     "blunt the edge, leave out the wall that fluid does not reach, or choose treatment = \"adami\""});
        }
        next.push_back(mirror);
      }
    for (const auto& mirror : next) add_mirror(mirror);
    last = std::move(next);
  }
}

template <int N>
void Mirrors<N>::add_mirror(Mirror<N> mirror) {
  for (int k = 0; k < mirror.count; ++k)
    mirror.wall_velocity += solids_[faces_[mirror.planes[k]].solid].velocity / static_cast<double>(mirror.count);
  mirrors_.push_back(mirror);
}

/// Whether planes meet in the domain on the surface of their solids and outside of all others. Edges in space are
/// clipped; one that is hidden in several solids, but in none of them wholly, counts as there.
template <int N>
bool Mirrors<N>::meet(const Mirror<N>& mirror, const Domain<N>& domain) const {
  if (mirror.count == 1) return true;
  const Vec<N> at = mirror.foot({});
  if (mirror.count == N) {
    for (int k = 0; k < N; ++k)
      if (at[k] < domain.low[k] - reach_ || at[k] > domain.high[k] + reach_) return false;
    return on_surface(mirror, at) && !std::ranges::any_of(solids_, [&](const auto& solid) {
             return std::ranges::all_of(solid.faces, [&](const auto& face) { return face.height(at) < -tolerance_; });
           });
  }
  if constexpr (N == 3) {
    const Vec<3> along = cross(mirror.axes[0], mirror.axes[1]);
    double low = -infinity, high = infinity;
    // Keeps the part with slope t + start <= 0.
    const auto clip = [&](double slope, double start) {
      if (std::abs(slope) < 1e-12) {
        if (start > 0) low = infinity;
      } else if (slope > 0) {
        high = std::min(high, -start / slope);
      } else {
        low = std::max(low, -start / slope);
      }
    };
    for (int k = 0; k < N; ++k) {
      clip(along[k], at[k] - domain.high[k] - reach_);
      clip(-along[k], domain.low[k] - reach_ - at[k]);
    }
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      const bool own = faces_[mirror.planes[0]].solid == static_cast<int>(s) ||
                       faces_[mirror.planes[1]].solid == static_cast<int>(s);
      const auto& faces = solids_[s].faces;
      for (std::size_t f = 0; f < faces.size(); ++f) {
        const double slope = dot(faces[f].normal, along), height = faces[f].height(at);
        if (own && !has(mirror, first_face_[s] + static_cast<int>(f))) clip(slope, height - tolerance_);
        if (!own && faces.size() == 1) clip(-slope, -height - tolerance_);
      }
    }
    if (!(high - low > tolerance_)) return false;
    if (!std::isfinite(low) || !std::isfinite(high)) return true;
    const Vec<3> first = at + (low + 2 * tolerance_) * along, last = at + (high - 2 * tolerance_) * along;
    return std::ranges::none_of(solids_, [&](const auto& solid) {
      return std::ranges::all_of(solid.faces, [&](const auto& face) {
        return face.height(first) < -tolerance_ && face.height(last) < -tolerance_;
      });
    });
  }
  return true;
}

/// Whether a point of a mirror's planes lies on the faces themselves.
template <int N>
bool Mirrors<N>::on_surface(const Mirror<N>& mirror, const Vec<N>& c) const {
  for (int k = 0; k < mirror.count; ++k) {
    const auto& faces = solids_[faces_[mirror.planes[k]].solid].faces;
    if (faces.size() == 1) continue;
    for (const auto& face : faces)
      if (face.height(c) > tolerance_) return false;
  }
  return true;
}

/// Whether no wall is between a particle and a point of the surface.
template <int N>
bool Mirrors<N>::sees(const Vec<N>& x, const Vec<N>& c) const {
  for (const auto& solid : solids_) {
    double low = 0, high = 1;  // the part of the way from x to c that is deeper than rounding in the solid
    for (const auto& face : solid.faces) {
      const double start = face.height(x) + tolerance_, end = face.height(c) + tolerance_;
      if (start >= 0 && end >= 0) {
        low = 2;
        break;
      }
      if (start >= 0) low = std::max(low, start / (start - end));
      if (end >= 0) high = std::min(high, start / (start - end));
    }
    if (low < high) return false;
  }
  return true;
}

/// Whether a point lies in a solid other than the one named.
template <int N>
bool Mirrors<N>::covered(const Vec<N>& x, int but_for) const {
  for (std::size_t s = 0; s < solids_.size(); ++s) {
    if (static_cast<int>(s) == but_for) continue;
    if (std::ranges::all_of(solids_[s].faces, [&](const auto& face) { return face.height(x) <= tolerance_; }))
      return true;
  }
  return false;
}

/// Whether fluid may touch a mirror at a point of its planes.
template <int N>
bool Mirrors<N>::open(const Mirror<N>& mirror, const Vec<N>& c) const {
  if (!on_surface(mirror, c)) return false;
  Vec<N> before = c;
  for (int k = 0; k < mirror.count; ++k) before += 10 * tolerance_ * faces_[mirror.planes[k]].plane.normal;
  return !covered(before, no_solid);
}

/// Whether y lies in a wall, and no other mirror that fluid may touch is nearer to it. Of two that are as near the
/// first in the list has it.
template <int N>
bool Mirrors<N>::nearest(int index, const Vec<N>& y, double depth) const {
  if (!covered(y, no_solid)) return false;
  for (int m = 0; m < count(); ++m) {
    if (m == index) continue;
    const Vec<N> c = mirrors_[m].foot(y);
    const double distance = norm(y - c);
    if (distance > depth + tolerance_ || (distance > depth - tolerance_ && index < m)) continue;
    if (open(mirrors_[m], c)) return false;
  }
  return true;
}

template <int N>
void Mirrors<N>::images(const Vec<N>& x, double reach, std::vector<Image>& found) const {
  for (int m = 0; m < count(); ++m) {
    const auto& mirror = mirrors_[m];
    std::array<Vec<N>, N> normals;
    bool near = true;
    for (int k = 0; k < mirror.count && near; ++k) {
      const auto& plane = faces_[mirror.planes[k]].plane;
      const double height = plane.height(x);
      near = height > 0 && height < reach;
      normals[k] = plane.normal;
    }
    if (!near) continue;
    const Vec<N> c = mirror.foot(x), y = mirror.image(x);
    const double depth = norm(x - c);
    if (!(depth < reach) || !in_cone<N>(x - c, normals, mirror.count)) continue;
    if (!on_surface(mirror, c) || !sees(x, c) || !nearest(m, y, depth)) continue;
    found.push_back({m, y});
  }
}

template class Mirrors<1>;
template class Mirrors<2>;
template class Mirrors<3>;

}  // namespace undine::walls
