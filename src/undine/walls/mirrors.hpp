#pragma once
#include <array>
#include <string>
#include <vector>

#include "undine/core/domain.hpp"
#include "undine/walls/answer.hpp"

namespace undine::walls {

/// A flat face of a wall, normal.x = offset.
template <int N>
struct Plane {
  Vec<N> normal;  ///< unit, into the fluid
  double offset = 0;

  /// How far a point is on the fluid's side, m.
  double height(const Vec<N>& x) const { return dot(normal, x) - offset; }
};

/// A convex piece of wall: what lies behind all its faces. With one face it is a half-space, such as below a floor.
template <int N>
struct Solid {
  std::vector<Plane<N>> faces;
  std::string name;   ///< of the wall that it belongs to, for messages
  Vec<N> velocity{};  ///< at which the wall slides in its own faces, m/s
};

/// A face, or an edge or corner where walls meet. A point is turned round in the space normal to it: at a face that is
/// its mirror image, at an edge of 90 degrees the product of two reflections.
template <int N>
struct Mirror {
  int count = 0;                    ///< of planes that meet: 1 for a face
  std::array<int, N> planes{};      ///< in the list of all faces
  std::array<Vec<N>, N> axes{};     ///< orthonormal, and spanning the normals
  std::array<double, N> offsets{};  ///< the mirror is where axis.x = offset for each axis
  Vec<N> wall_velocity{};           ///< mean of the walls that meet

  /// The nearest point of the mirror.
  Vec<N> foot(const Vec<N>& x) const {
    Vec<N> c = x;
    for (int k = 0; k < count; ++k) c -= axes[k] * (dot(axes[k], x) - offsets[k]);
    return c;
  }
  Vec<N> image(const Vec<N>& x) const {
    Vec<N> y = x;
    for (int k = 0; k < count; ++k) y -= axes[k] * (2 * (dot(axes[k], x) - offsets[k]));
    return y;
  }
  /// The image of a vector that turns with the fluid.
  Vec<N> turned(const Vec<N>& v) const {
    Vec<N> u = v;
    for (int k = 0; k < count; ++k) u -= axes[k] * (2 * dot(axes[k], v));
    return u;
  }
  Vec<N> velocity(const Vec<N>& v, Slip slip) const {
    if (slip == Slip::none) return 2.0 * wall_velocity - v;
    Vec<N> u = v;
    for (int k = 0; k < count; ++k) u -= axes[k] * (2 * dot(axes[k], v - wall_velocity));
    return u;
  }
};

/// The walls of ghost particles. Every place in a wall is filled at most once: with the fluid turned round the point c
/// of the wall's surface that is nearest to that place. So a ghost at y has its parent at x = 2 c - y, which gives
///   behind a face its mirror images;
///   beyond an edge where the fluid fills 90 degrees or more the point image (three ghosts in a corner of a plane,
///   seven in a corner of space);
///   inside an obstacle the images over its nearest face, and none beside its edges.
/// No ghost lies in the fluid. Niedoba (2012), 2.2.5 and 3.3; Boerve (2011) on masses.
template <int N>
class Mirrors {
 public:
  /// Parents are looked for up to `reach` from a wall (m). Throws InputError naming the walls where two of them meet at
  /// less than 90 degrees, or are so near to each other that fluid would need images of images.
  Mirrors(std::vector<Solid<N>> solids, Slip slip, double reach, const Domain<N>& domain);

  struct Image {
    int mirror;
    Vec<N> x;
  };
  /// All ghosts of a fluid particle at x that lie less than `reach` deep in a wall, appended to `found`.
  void images(const Vec<N>& x, double reach, std::vector<Image>& found) const;

  const Mirror<N>& mirror(int index) const { return mirrors_[index]; }
  int count() const { return static_cast<int>(mirrors_.size()); }
  Slip slip() const { return slip_; }
  /// The wall that a mirror belongs to; where several meet, the one named first.
  const std::string& wall(int index) const { return solids_[faces_[mirrors_[index].planes[0]].solid].name; }

 private:
  /// Which solid a plane belongs to.
  struct Face {
    Plane<N> plane;
    int solid;
  };

  void repeat(const Domain<N>& domain);
  void check_gaps() const;
  void find_mirrors(const Domain<N>& domain);
  void add_mirror(Mirror<N> mirror);
  bool meet(const Mirror<N>& mirror, const Domain<N>& domain) const;
  bool on_surface(const Mirror<N>& mirror, const Vec<N>& c) const;
  bool sees(const Vec<N>& x, const Vec<N>& c) const;
  bool open(const Mirror<N>& mirror, const Vec<N>& c) const;
  bool nearest(int index, const Vec<N>& y, double depth) const;
  bool covered(const Vec<N>& x, int but_for) const;
  bool exposed(int solid, std::size_t face) const;
  bool has(const Mirror<N>& mirror, int plane) const;

  std::vector<Solid<N>> solids_;
  std::vector<int> first_face_;  ///< of each solid in faces_
  std::vector<Face> faces_;
  std::vector<Mirror<N>> mirrors_;
  Slip slip_;
  double reach_ = 0, tolerance_ = 0;
};

extern template class Mirrors<1>;
extern template class Mirrors<2>;
extern template class Mirrors<3>;

}  // namespace undine::walls
