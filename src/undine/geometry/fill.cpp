#include "undine/geometry/fill.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

constexpr double most_points = 4e9;
/// In spacings: points are tested this far up along each axis, so that those on a face fall to one side for sure.
constexpr double nudge = 1e-6;

void check_spacing(double spacing, int dimensions) {
  if (!(std::isfinite(spacing) && spacing > 0)) {
    throw InputError({.what = "the particle spacing must be above 0", .why = fmt::format("it is {} m", spacing)});
  }
  if (dimensions < 1 || dimensions > 3) {
    throw InputError({.what = "a case has 1, 2 or 3 dimensions", .why = fmt::format("{} were given", dimensions)});
  }
}

void check_bounded(const Bounds& box, double spacing, int dimensions) {
  double count = 1;
  for (int k = 0; k < dimensions; ++k) {
    if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k])) {
      throw InputError({.what = fmt::format("a shape without end along {} cannot be filled", "xyz"[k]),
                        .fix = "intersect it with a box"});
    }
    count *= std::max(1.0, (box.hi[k] - box.lo[k]) / spacing);
  }
  if (count > most_points) {
    throw InputError(
        {.what = "the spacing is far too small for the shape",
         .why = fmt::format("{:.3g} lattice points would have to be tried at a spacing of {} m", count, spacing),
         .fix = "lengths are in metres: check both"});
  }
}

Vec3 nudged(const Vec3& p, double spacing, int dimensions) {
  Vec3 q = p;
  for (int k = 0; k < dimensions; ++k) q[k] += nudge * spacing;
  return q;
}

/// Visit cell centres anchor + (i + 1/2) step + shift(row, layer) along each axis within the box.
struct LatticeShape {
  Vec3 step;               ///< m
  bool hexagonal = false;  ///< odd rows move on by step/2; odd layers by step/2 in x and a third of a row in y

  Vec3 shift(int dimensions, long row, long layer) const {
    const double odd_row = row % 2 != 0;
    const double odd_layer = layer % 2 != 0;
    if (!hexagonal || dimensions < 2) return {};
    // Centred on the cell: rows lie a quarter step left and right of its middle, layers a sixth of a row up and down.
    const double x = dimensions == 2 ? odd_row - 0.5 : (odd_row + odd_layer == 1) - 0.5;
    const double y = dimensions == 2 ? 0.0 : (odd_layer - 0.5) / 3;
    return {{0.5 * x * step[0], y * step[1], 0}};
  }
};

LatticeShape lattice_of(Lattice kind, double spacing, int dimensions) {
  const double s = spacing;
  if (kind == Lattice::cubic || dimensions == 1) return {{{s, s, s}}, false};
  if (dimensions == 2) {
    const double a = s * std::sqrt(2 / std::sqrt(3.0));
    return {{{a, a * std::sqrt(0.75), s}}, true};
  }
  const double a = s * std::cbrt(std::sqrt(2.0));
  return {{{a, a * std::sqrt(0.75), a * std::sqrt(2.0 / 3)}}, true};
}

template <class Visit>
void for_lattice(const Bounds& box, const Vec3& anchor, const LatticeShape& lattice, int dimensions, Visit visit) {
  std::array<long, 3> begin{};
  std::array<long, 3> end{1, 1, 1};
  for (int k = 0; k < dimensions; ++k) {
    begin[k] = std::lround(std::floor((box.lo[k] - anchor[k]) / lattice.step[k])) - 1;
    end[k] = std::lround(std::ceil((box.hi[k] - anchor[k]) / lattice.step[k])) + 2;
  }
  for (long z = begin[2]; z < end[2]; ++z) {
    for (long y = begin[1]; y < end[1]; ++y) {
      for (long x = begin[0]; x < end[0]; ++x) {
        const std::array<long, 3> cell{x, y, z};
        Vec3 p = lattice.shift(dimensions, y, z);
        for (int k = 0; k < 3; ++k) {
          p[k] = k < dimensions ? anchor[k] + (static_cast<double>(cell[k]) + 0.5) * lattice.step[k] + p[k] : 0.0;
        }
        visit(p);
      }
    }
  }
}

/// One coordinate of a lattice that follows a box, and which layer of the lower and upper face it is in (0: none).
struct Tick {
  double x;
  int lower, upper;
};

std::vector<Tick> ticks_of(double lo, double hi, const ShellSpec& spec) {
  const double s = spec.spacing;
  std::vector<Tick> ticks;
  if (spec.side == Side::outside) {
    const long n = std::max(1l, std::lround((hi - lo) / s));
    for (int k = spec.layers; k-- > 0;) ticks.push_back({lo - (spec.offset + k) * s, k + 1, 0});
    for (long i = 0; i < n; ++i) {
      ticks.push_back({lo + (static_cast<double>(i) + 0.5) * (hi - lo) / static_cast<double>(n), 0, 0});
    }
    for (int k = 0; k < spec.layers; ++k) ticks.push_back({hi + (spec.offset + k) * s, 0, k + 1});
    return ticks;
  }
  const double inner = hi - lo - 2 * spec.offset * s;
  const long steps = std::max(0l, std::lround(inner / s));
  for (long i = 0; i <= steps; ++i) {
    const double part = steps > 0 ? static_cast<double>(i) / static_cast<double>(steps) : 0.5;
    ticks.push_back({lo + spec.offset * s + part * inner, i < spec.layers, steps - i < spec.layers});
  }
  return ticks;
}

std::vector<Vec3> box_shell(const Bounds& box, const ShellSpec& spec) {
  std::array<std::vector<Tick>, 3> ticks;
  for (int k = 0; k < 3; ++k) {
    ticks[k] = k < spec.dimensions ? ticks_of(box.lo[k], box.hi[k], spec) : std::vector<Tick>{{0, 0, 0}};
  }
  std::vector<Vec3> points;
  for (const Tick& z : ticks[2]) {
    for (const Tick& y : ticks[1]) {
      for (const Tick& x : ticks[0]) {
        const std::array<Tick, 3> at{x, y, z};
        bool in_layer = false;
        bool beyond_open = false;
        for (int k = 0; k < spec.dimensions; ++k) {
          const bool lower = at[k].lower > 0;
          const bool upper = at[k].upper > 0;
          in_layer |= (lower && !spec.open.has(k, 0)) || (upper && !spec.open.has(k, 1));
          beyond_open |= (lower && spec.open.has(k, 0)) || (upper && spec.open.has(k, 1));
        }
        if (in_layer && !(beyond_open && spec.side == Side::outside)) points.push_back({{x.x, y.x, z.x}});
      }
    }
  }
  return points;
}

}  // namespace

std::vector<Vec3> fill_lattice(const Shape& shape, const LatticeSpec& spec) {
  check_spacing(spec.spacing, spec.dimensions);
  const Bounds box = shape.bounds();
  check_bounded(box, spec.spacing, spec.dimensions);
  std::vector<Vec3> points;
  for_lattice(box, spec.anchor.value_or(box.lo), lattice_of(spec.kind, spec.spacing, spec.dimensions), spec.dimensions,
              [&](const Vec3& p) {
                if (shape.inside(nudged(p, spec.spacing, spec.dimensions))) points.push_back(p);
              });
  return points;
}

std::vector<Vec3> fill_shell(const Shape& shape, const ShellSpec& spec) {
  check_spacing(spec.spacing, spec.dimensions);
  if (spec.layers < 1 || !(spec.offset >= 0)) {
    throw InputError({.what = "a shell needs at least one layer, at an offset of 0 or more",
                      .why = fmt::format("{} layers and offset {} were given", spec.layers, spec.offset)});
  }
  Bounds box = shape.bounds();
  check_bounded(box, spec.spacing, spec.dimensions);
  if (shape.as_box()) return box_shell(box, spec);
  for (int face = 0; face < 6; ++face) {
    if (spec.open.has(face / 2, face % 2)) {
      throw InputError({.what = "only a box can have open faces", .fix = "use a box, or subtract a shape instead"});
    }
  }
  const Vec3 anchor = box.lo;
  const double nearest = (spec.offset - 0.5) * spec.spacing;
  const double farthest = nearest + spec.layers * spec.spacing;
  if (spec.side == Side::outside) {
    for (int k = 0; k < 3; ++k) box.lo[k] -= farthest, box.hi[k] += farthest;
    check_bounded(box, spec.spacing, spec.dimensions);
  }
  std::vector<Vec3> points;
  for_lattice(box, anchor, lattice_of(Lattice::cubic, spec.spacing, spec.dimensions), spec.dimensions,
              [&](const Vec3& p) {
                const double d = shape.signed_distance(nudged(p, spec.spacing, spec.dimensions));
                const double away = spec.side == Side::outside ? d : -d;
                if (away > nearest && away <= farthest) points.push_back(p);
              });
  return points;
}

std::vector<Vec3> fill_face_sheet(const Bounds& box, const SheetSpec& spec) {
  check_spacing(spec.spacing, spec.dimensions);
  check_bounded(box, spec.spacing, spec.dimensions);
  std::array<std::vector<double>, 3> centres;
  for (int k = 0; k < 3; ++k) {
    const double length = box.hi[k] - box.lo[k];
    const long n = k < spec.dimensions ? std::max(1l, std::lround(length / spec.spacing)) : 1;
    for (long i = 0; i < n; ++i) {
      const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
      centres[k].push_back(k < spec.dimensions ? box.lo[k] + part * length : 0.0);
    }
  }
  std::vector<Vec3> points;
  for (int axis = 0; axis < spec.dimensions; ++axis) {
    for (int end = 0; end < 2; ++end) {
      if (spec.open.has(axis, end)) continue;
      auto sheet = centres;
      sheet[axis] = {end == 0 ? box.lo[axis] : box.hi[axis]};
      for (const double z : sheet[2]) {
        for (const double y : sheet[1]) {
          for (const double x : sheet[0]) points.push_back({{x, y, z}});
        }
      }
    }
  }
  return points;
}

}  // namespace undine
