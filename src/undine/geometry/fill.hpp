#pragma once
#include <optional>
#include <vector>

#include "undine/geometry/faces.hpp"
#include "undine/geometry/shape.hpp"

namespace undine {

enum class Lattice { cubic, hexagonal };

/// How to fill a shape with points. Each point stands for the volume spacing^dimensions on either lattice; nearest
/// neighbours are then 1 spacing apart (cubic), 1.075 (hexagonal in 2-D), 1.122 (hexagonal close packing in 3-D).
struct LatticeSpec {
  double spacing = 0;  ///< m
  int dimensions = 3;  ///< unused coordinates of the points are 0
  Lattice kind = Lattice::cubic;
  std::optional<Vec3> anchor = {};  ///< a corner of a cell, m; the lower corner of the shape's bounds if not given
};

/// The lattice points inside the shape, at the centres of cells, in order of z, then y, then x. A box of extent L that
/// holds the anchor on its lower corner gets round(L / spacing) points along an axis, the outer ones spacing/2 from the
/// faces. A point exactly on a face is inside for a lower face and outside for an upper one, whatever the rounding, so
/// that adjoining shapes share no points and leave none out. InputError for an unbounded shape or an absurd count.
std::vector<Vec3> fill_lattice(const Shape& shape, const LatticeSpec& spec);

/// How to cover a surface with layers of wall particles.
struct ShellSpec {
  double spacing = 0;  ///< m
  int layers = 1;
  Side side = Side::outside;
  int dimensions = 3;
  double offset = 0.5;  ///< distance of the first layer from the surface, in spacings
  FaceSet open = {};    ///< faces left out; for boxes only
};

/// Lattice points within `layers` spacings of the surface on one side. Around a box the lattice follows its faces, so a
/// box of extent L has round(L / spacing) points along an edge in each layer, and edges and corners are filled outside.
/// Around other shapes it is the cubic lattice of fill_lattice, cut at the distances (offset - 1/2) spacing and
/// (offset - 1/2 + layers) spacing. InputError as fill_lattice, and for open faces of a shape that is no box.
std::vector<Vec3> fill_shell(const Shape& shape, const ShellSpec& spec);

/// One sheet of points on each face of a box (m), at the centres of the face's cells: round(L / spacing) per edge,
/// stretched to fit. A box of 1 m with spacing 0.02 has 50 x 50 on each of its six faces.
struct SheetSpec {
  double spacing = 0;  ///< m
  int dimensions = 3;
  FaceSet open = {};  ///< faces left out
};
std::vector<Vec3> fill_face_sheet(const Bounds& box, const SheetSpec& spec);

}  // namespace undine
