#pragma once
#include <functional>
#include <vector>

#include "undine/geometry/bounds.hpp"

namespace undine {

/// One stretch of a segment that lies inside a shape, as fractions 0 <= begin < end <= 1 of the segment.
/// An end is `cut` where the segment crosses the surface there; it then has the outward unit normal.
struct Span {
  double begin = 0;
  double end = 1;
  bool begin_cut = false;
  bool end_cut = false;
  Vec3 begin_normal{};
  Vec3 end_normal{};
};

/// The stretches in order, apart from each other.
using Spans = std::vector<Span>;

/// A surface crossing at fraction `at` of a segment, with the outward unit normal.
struct Cut {
  double at = 0;
  Vec3 normal{};
};

/// The part of a convex shape's stretch [in, out] of a whole line that lies within [0, 1].
Spans convex_spans(const Cut& in, const Cut& out);

/// The stretches of a shape known by all its crossings (any order, doubles allowed) and an inside test of a fraction.
Spans spans_from_cuts(std::vector<Cut> cuts, const Vec3& direction, const std::function<bool(double)>& inside);

/// What is inside both. Stretches thinner than `thin` (a fraction), cut at both ends, are rounding errors and dropped.
Spans both_spans(const Spans& a, const Spans& b, double thin);

/// What is outside, with the normals turned round. `thin` as above.
Spans other_spans(const Spans& a, double thin);

}  // namespace undine
