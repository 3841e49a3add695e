#include "undine/geometry/shape.hpp"

#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "sample_shapes.hpp"
#include "undine/geometry/fill.hpp"

namespace undine {
namespace {

using sample::error_of;

double counted_volume(const Shape& shape, double spacing, int dimensions = 3) {
  const auto points = fill_lattice(shape, {.spacing = spacing, .dimensions = dimensions});
  return static_cast<double>(points.size()) * std::pow(spacing, dimensions);
}

TEST(GeometryShape, SphereVolumeConverges) {
  const auto sphere = make_sphere({{0.1, 0.2, 0.3}}, 1);
  const double exact = 4.0 / 3 * std::numbers::pi;
  // The count's error is that of the surface cells: below 1 % at 20 per diameter, below 0.1 % at 100.
  EXPECT_NEAR(counted_volume(*sphere, 0.1) / exact, 1, 1e-2);
  EXPECT_NEAR(counted_volume(*sphere, 0.02) / exact, 1, 1e-3);
}

TEST(GeometryShape, CylinderVolumeAndArea) {
  const auto cylinder = make_cylinder({{0, 0, 0}}, {{1, 1, 0.5}}, 0.4);
  // As for the sphere: below 1 %.
  EXPECT_NEAR(counted_volume(*cylinder, 0.02) / (std::numbers::pi * 0.16 * 1.5), 1, 1e-2);
  // In the plane z = 0 a disc; below 1 %.
  EXPECT_NEAR(counted_volume(*make_sphere({}, 0.5), 0.01, 2) / (std::numbers::pi * 0.25), 1, 1e-2);
}

TEST(GeometryShape, UnionAndDifference) {
  const auto a = make_box({{0, 0, 0}}, {{1, 1, 1}});
  const auto b = make_box({{0.5, 0, 0}}, {{2, 1, 1}});
  // Box sizes are whole multiples of the spacing, so the counts are exact.
  EXPECT_NEAR(counted_volume(*make_union({a, b}), 0.1), 2.0, 1e-12);
  EXPECT_NEAR(counted_volume(*make_difference(a, b), 0.1), 0.5, 1e-12);
  EXPECT_NEAR(counted_volume(*make_intersection({a, b}), 0.1), 0.5, 1e-12);
}

TEST(GeometryShape, AdjoiningBoxesHaveNoInnerWall) {
  const auto both = make_union({make_box({{0, 0, 0}}, {{0.3, 1, 1}}), make_box({{0.1 + 0.2, 0, 0}}, {{1, 1, 1}})});
  // A segment along both is one stretch, though 0.1 + 0.2 differs from 0.3 by a rounding error.
  const auto spans = both->spans({{-1, 0.5, 0.5}}, {{2, 0.5, 0.5}});
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_NEAR(spans[0].begin, 1.0 / 3, 1e-12);
  EXPECT_NEAR(spans[0].end, 2.0 / 3, 1e-12);
  // Lattice points on the common face are in: 3^3 points at a spacing of 1/3... of which x = 0.5 lies on x = 0.5 here.
  const auto halves = make_union({make_box({{0, 0, 0}}, {{0.5, 1, 1}}), make_box({{0.5, 0, 0}}, {{1, 1, 1}})});
  EXPECT_EQ(fill_lattice(*halves, {.spacing = 1.0 / 3}).size(), 27u);
}

TEST(GeometryShape, PlaneAndLineCases) {
  const auto box = make_box({{0, 0}}, {{2, 1}}, 2);
  // Exact distances of a rectangle: inside, beside a face, off a corner (3-4-5).
  EXPECT_DOUBLE_EQ(box->signed_distance({{1, 0.25, 0}}), -0.25);
  EXPECT_DOUBLE_EQ(box->signed_distance({{1, 1.5, 0}}), 0.5);
  EXPECT_DOUBLE_EQ(box->signed_distance({{2.3, 1.4, 0}}), 0.5);
  const auto line = make_box({{-1}}, {{1}}, 1);
  EXPECT_DOUBLE_EQ(line->signed_distance({{0.75, 0, 0}}), -0.25);
  EXPECT_EQ(line->normal({{-2, 0, 0}})[0], -1);
}

TEST(GeometryShape, PolygonAreaDistanceAndExtrusion) {
  const std::vector<std::array<double, 2>> ell{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const auto flat = make_polygon({.corners = ell});
  // Area 3, exact as the edges lie on cell boundaries.
  EXPECT_NEAR(counted_volume(*flat, 0.1, 2), 3.0, 1e-12);
  // Nearest point is the inner corner (1, 1).
  EXPECT_NEAR(flat->signed_distance({{1.3, 1.4, 7}}), 0.4 - 0.1, 1e-12);
  EXPECT_NEAR(flat->signed_distance({{0.7, 0.6, 7}}), -0.5, 1e-12);
  const auto solid = make_polygon({ell, PolygonPlane::xz, 0, 0.5});
  // Volume 3 x 0.5 in x-z, extruded along y.
  EXPECT_NEAR(counted_volume(*solid, 0.1), 1.5, 1e-12);
  EXPECT_NEAR(solid->bounds().hi[2], 2, 0);
}

TEST(GeometryShape, PolygonRefusesWhatIsNotSimple) {
  const auto of = [](std::vector<std::array<double, 2>> corners) {
    return error_of([&] { make_polygon({.corners = std::move(corners)}); });
  };
  // Each message names the fault.
  EXPECT_NE(of({{0, 0}, {1, 1}, {1, 0}, {0, 1}}).find("meets edge"), std::string::npos);
  EXPECT_NE(of({{0, 0}, {1, 0}}).find("3 is the least"), std::string::npos);
  EXPECT_NE(of({{0, 0}, {1, 0}, {0.5, 0}}).find("turns back"), std::string::npos);
  EXPECT_NE(of({{0, 0}, {0, 0}, {1, 0}, {0, 1}}).find("coincide"), std::string::npos);
  // A repeated first corner at the end and clockwise order are fine.
  EXPECT_EQ(of({{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}}), "");
}

TEST(GeometryShape, BadSizesAreErrors) {
  // One message for each wrong size.
  EXPECT_NE(error_of([] { make_box({{0, 1, 0}}, {{1, 0, 1}}); }).find("along y"), std::string::npos);
  EXPECT_NE(error_of([] { make_sphere({}, 0); }).find("radius"), std::string::npos);
  EXPECT_NE(error_of([] { make_cylinder({}, {}, 1); }).find("end points"), std::string::npos);
  EXPECT_NE(error_of([] { make_half_space({}, {}); }).find("normal"), std::string::npos);
  EXPECT_NE(error_of([] { make_union({}); }).find("union"), std::string::npos);
}

std::vector<ShapePtr> all_shapes() {
  const auto box = make_box({{0, 0, 0}}, {{1, 2, 1}});
  const auto sphere = make_sphere({{0.5, 0.5, 0.5}}, 0.7);
  return {box,
          sphere,
          make_cylinder({{0, 0, 0}}, {{1, 1, 1}}, 0.5),
          make_half_space({{0.3, 0, 0}}, {{1, 2, 3}}),
          make_polygon({{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, PolygonPlane::xz, -1, 1}),
          make_union({box, sphere}),
          make_difference(box, sphere),
          make_intersection({box, sphere}),
          make_mesh(sample::ball(2)),
          make_mesh(sample::ell())};
}

RC_GTEST_PROP(GeometryShape, DistanceIsLipschitzAndCrossingsAgreeWithIt, ()) {
  static const auto shapes = all_shapes();
  const int which = sample::index(static_cast<int>(shapes.size()));
  const auto& shape = *shapes[which];
  const Vec3 a = sample::point(-1, 3);
  const Vec3 b = sample::point(-1, 3);
  const double da = shape.signed_distance(a);
  // A distance changes by no more than the way between two points.
  RC_ASSERT(std::abs(da - shape.signed_distance(b)) <= norm(b - a) * (1 + 1e-9) + 1e-12);
  const Vec3 n = shape.normal(a);
  RC_ASSERT(std::abs(norm(n) - 1) < 1e-12);
  // A step back along the normal leads straight to the surface (difference and intersection, 6 and 7, only bound it).
  if (da > 1e-3 && which != 6 && which != 7) {
    RC_ASSERT(std::abs(shape.signed_distance(a - 1e-4 * n) - (da - 1e-4)) < 1e-9);
  }
  // The middle of each stretch is inside, the middle of each gap is not (unless it is a touch), and cut ends lie on the
  // surface.
  double last = 0;
  for (const Span& span : shape.spans(a, b)) {
    const auto at = [&](double t) { return a + t * (b - a); };
    if (span.end - span.begin > 1e-9) RC_ASSERT(shape.signed_distance(at(0.5 * (span.begin + span.end))) <= 0);
    if (span.begin - last > 1e-9) RC_ASSERT(shape.signed_distance(at(0.5 * (last + span.begin))) >= 0);
    if (span.begin_cut) RC_ASSERT(std::abs(shape.signed_distance(at(span.begin))) < 1e-9);
    if (span.end_cut) RC_ASSERT(std::abs(shape.signed_distance(at(span.end))) < 1e-9);
    if (span.end_cut) RC_ASSERT(std::abs(norm(span.end_normal) - 1) < 1e-12);
    last = span.end;
  }
  // `clear` is never wrong: then no crossing is found.
  for (const Side side : {Side::inside, Side::outside}) {
    if (shape.clear(a, b, side)) RC_ASSERT(!shape.first_crossing(a, b, side).has_value());
  }
}

}  // namespace
}  // namespace undine
