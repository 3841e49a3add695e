#include "undine/geometry/surface.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "sample_shapes.hpp"

namespace undine {
namespace {

const Bounds unit_box{{{0, 0, 0}}, {{1, 1, 1}}};

/// Where a straight path ends after mirroring at 0 and 1 as often as needed.
double folded(double x) {
  const double r = x - 2 * std::floor(x / 2);
  return r <= 1 ? r : 2 - r;
}

struct Named {
  const char* name;
  double lo, hi;  ///< starts are drawn from this cube
  ReflectingSurface walls;
};

/// One of each kind.
const std::vector<Named>& all_walls() {
  static const auto list = [] {
    std::vector<Named> all(8);
    all[0].name = "box", all[0].lo = 0, all[0].hi = 1;
    all[0].walls.add_tank(unit_box, 3);
    all[1].name = "L-shaped mesh", all[1].lo = 0, all[1].hi = 2;
    all[1].walls.add(make_mesh(sample::ell()), Side::inside);
    all[2].name = "outside of a sphere", all[2].lo = -1, all[2].hi = 3;
    all[2].walls.add(make_sphere({{1, 1, 1}}, 1), Side::outside);
    all[3].name = "tank with two obstacles, one in a corner", all[3].lo = -1, all[3].hi = 3;
    all[3].walls.add_tank({{{-1, -1, -1}}, {{3, 3, 3}}}, 3, parse_faces({"z+"}));
    all[3].walls.add(make_sphere({{1, 1, 1}}, 1), Side::outside);
    all[3].walls.add(make_box({{-2, -2, -2}}, {{0, 0, 0}}), Side::outside);
    all[4].name = "wedge of planes", all[4].lo = 0, all[4].hi = 2;
    all[4].walls.add_plane({}, {{0.3, 1, 0}});
    all[4].walls.add_plane({}, {{0.3, -1, 0}});
    all[5].name = "inside of a cylinder", all[5].lo = 0, all[5].hi = 2;
    all[5].walls.add(make_cylinder({{1, 1, -1}}, {{1, 1, 3}}, 1), Side::inside);
    all[6].name = "two joined boxes less a ball", all[6].lo = 0, all[6].hi = 2;
    all[6].walls.add(
        make_difference(make_union({make_box({{0, 0, 0}}, {{1, 1, 1}}), make_box({{1, 0, 0}}, {{2, 2, 1}})}),
                        make_sphere({{1, 1, 0}}, 0.3)),
        Side::inside);
    all[7].name = "outside of a mesh", all[7].lo = -1.5, all[7].hi = 1.5;
    all[7].walls.add(make_mesh(sample::map_points(sample::ball(2), sample::rotated)), Side::outside);
    return all;
  }();
  return list;
}

RC_GTEST_PROP(GeometrySurface, AlwaysEndsOnTheFluidSide, ()) {
  const auto& [name, lo, hi, walls] = all_walls()[sample::index(static_cast<int>(all_walls().size()))];
  const Vec3 from = sample::point(lo, hi);
  RC_PRE(walls.depth(from) >= 0);
  const double reach = std::pow(10.0, sample::index(15) - 12);
  const Vec3 step = reach * sample::point(-1, 1);
  const auto r = walls.reflect(from, from + step, step);
  RC_TAG(name);
  // In the fluid by the walls' own measure, at most 16 reflections.
  RC_ASSERT(walls.depth(r.position) > 0);
  RC_ASSERT(r.hits <= ReflectingSurface::most_hits);
  // Elastic walls keep the speed, to 1e-12.
  RC_ASSERT(std::abs(norm(r.velocity) - norm(step)) <= 1e-12 * norm(step));
  // And the length of the path, to rounding at the size of the walls, unless it was cut short.
  if (!r.stopped) RC_ASSERT(std::abs(r.travelled - norm(step)) <= 1e-10 * (1 + norm(step)));
  // No tunnel: in small steps the L, the tank and others keep a point in one piece of fluid, so it can't go far.
  RC_ASSERT(norm(r.position - from) <= norm(step) * (1 + 1e-9) + 1e-10);
}

RC_GTEST_PROP(GeometrySurface, BoxMatchesUnfolding, ()) {
  ReflectingSurface tank;
  tank.add_tank(unit_box, 3);
  const Vec3 from = sample::point(0.01, 0.99);
  const Vec3 step = 4 * sample::point(-1, 1);
  const auto r = tank.reflect(from, from + step, step);
  // The mirrored path in a box is the unfolded straight one, to 1e-10.
  for (int k = 0; k < 3; ++k) RC_ASSERT(std::abs(r.position[k] - folded(from[k] + step[k])) < 1e-10);
  RC_ASSERT(!r.stopped);
}

RC_GTEST_PROP(GeometrySurface, OrderOfWallsInACornerDoesNotMatter, ()) {
  std::array<ReflectingSurface, 2> corner;
  for (int k = 0; k < 3; ++k) {
    Vec3 n{};
    n[k] = 1;
    corner[0].add_plane({}, n);
    Vec3 m{};
    m[2 - k] = 1;
    corner[1].add_plane({}, m);
  }
  const Vec3 from = sample::point(0, 1);
  const Vec3 step = sample::point(-3, 1);
  const auto a = corner[0].reflect(from, from + step, step);
  const auto b = corner[1].reflect(from, from + step, step);
  // Same end and velocity to 1e-10, also for paths exactly into an edge or the corner.
  RC_ASSERT(norm(a.position - b.position) < 1e-10);
  RC_ASSERT(norm(a.velocity - b.velocity) < 1e-10);
  for (int k = 0; k < 3; ++k) RC_ASSERT(std::abs(a.position[k] - std::abs(from[k] + step[k])) < 1e-10);
}

RC_GTEST_PROP(GeometrySurface, MeshAndPolygonReflectAlike, ()) {
  static const auto walls = [] {
    std::array<ReflectingSurface, 3> all;
    all[0].add(make_mesh(sample::ell()), Side::inside);
    all[1].add(make_polygon({.corners = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}), Side::inside);
    all[2].add(make_union({make_box({{0, 0}}, {{2, 1}}, 2), make_box({{0, 0}}, {{1, 2}}, 2)}), Side::inside);
    return all;
  }();
  const auto plain = [](double lo, double hi) { return lo + (hi - lo) * (sample::index(1'000'000) + 0.123) / 1e6; };
  const Vec3 from{{plain(0, 2), plain(0, 1), 0.5}};
  const Vec3 step{{plain(-3, 3), plain(-3, 3), 0}};
  const auto a = walls[0].reflect(from, from + step, step);
  // Triangles, edges of a polygon and joined boxes are three ways to the same end, to 1e-9.
  for (int k = 1; k < 3; ++k) {
    const auto b = walls[k].reflect(from, from + step, step);
    RC_ASSERT(a.hits == b.hits);
    RC_ASSERT(norm(a.position - b.position) < 1e-9);
    RC_ASSERT(norm(a.velocity - b.velocity) < 1e-9);
  }
}

RC_GTEST_PROP(GeometrySurface, StartOnOrJustOutsideDoesNotTunnel, ()) {
  static const auto ball = make_mesh(sample::ball(1));
  static const auto walls = [] {
    ReflectingSurface all;
    all.add_tank(unit_box, 3);
    all.add(ball, Side::outside);
    return all;
  }();
  const bool on_ball = sample::index(2) == 1;
  Vec3 from = sample::point(0.01, 0.99);
  if (on_ball) {
    for (int k = 0; k < 3; ++k) from = from - (ball->signed_distance(from) + 1e-12) * ball->normal(from);
    RC_PRE(from[0] > 0 && from[1] > 0 && from[2] > 0);
  } else {
    from[sample::index(3)] = std::array{0.0, 1.0, -1e-12, 1 + 1e-12}[sample::index(4)];
    RC_PRE(norm(from) > 1.01);
  }
  const Vec3 step = 0.1 * sample::point(-1, 1);
  const auto r = walls.reflect(from, from + step, step);
  // Ends in the fluid, no farther than the step.
  RC_ASSERT(walls.depth(r.position) > 0);
  RC_ASSERT(norm(r.position - from) <= norm(step) + 1e-10);
}

TEST(GeometrySurface, OneAndTwoDimensions) {
  ReflectingSurface line;
  line.add_tank({{{0}}, {{1}}}, 1);
  const auto r = line.reflect({{0.9, 0, 0}}, {{1.3, 0, 0}}, {{4, 0, 0}});
  // Mirrored at 1: 2 - 1.3; the other coordinates stay exactly 0.
  EXPECT_NEAR(r.position[0], 0.7, 1e-11);
  EXPECT_EQ(r.position[1], 0);
  EXPECT_EQ(r.position[2], 0);
  EXPECT_EQ(r.hits, 1);
  EXPECT_DOUBLE_EQ(r.velocity_change[0], -8);
  ReflectingSurface triangle;
  triangle.add(make_polygon({.corners = {{0, 0}, {1, 0}, {0, 1}}}), Side::inside);
  const auto s = triangle.reflect({{0.25, 0.25, 0}}, {{1.2, 0.25, 0}}, {{1, 0, 0}});
  // The hypotenuse at x = 0.75 turns the motion down to -y; after 0.25 m it meets y = 0 and comes back by 0.2 m.
  EXPECT_NEAR(s.position[0], 0.75, 1e-10);
  EXPECT_NEAR(s.position[1], 0.2, 1e-10);
  EXPECT_EQ(s.position[2], 0);
  EXPECT_NEAR(s.velocity[1], 1, 1e-12);
  EXPECT_EQ(s.hits, 2);
}

TEST(GeometrySurface, OpenFaceAndRestitution) {
  ReflectingSurface tank;
  tank.add_tank(unit_box, 3, parse_faces({"z+"}), 0.5);
  const auto up = tank.reflect({{0.5, 0.5, 0.9}}, {{0.5, 0.5, 1.5}}, {{0, 0, 1}});
  // Nothing above.
  EXPECT_EQ(up.hits, 0);
  EXPECT_EQ(up.position[2], 1.5);
  const auto down = tank.reflect({{0.5, 0.5, 0.2}}, {{0.7, 0.5, -0.2}}, {{2, 0, -4}});
  // The normal speed halves, so does the way back up: 0.2 * 0.5; the tangential part is untouched.
  EXPECT_NEAR(down.velocity[2], 2, 1e-12);
  EXPECT_EQ(down.velocity[0], 2);
  EXPECT_NEAR(down.position[2], 0.1, 1e-11);
  EXPECT_NEAR(down.position[0], 0.7, 1e-11);
}

TEST(GeometrySurface, InelasticPathSlidesRoundACylinder) {
  ReflectingSurface drum;
  drum.add(make_cylinder({{0, 0, -1}}, {{0, 0, 1}}, 1), Side::inside, 0);
  const auto r = drum.reflect({{0.999, 0, 0}}, {{0.999, 0.1, 0}}, {{0, 1, 0}});
  // It ends inside, within 1 % of the way along the wall instead of sticking at the first touch.
  EXPECT_GT(drum.depth(r.position), 0);
  EXPECT_NEAR(r.position[1], 0.1, 1e-3);
  EXPECT_FALSE(r.stopped);
}

TEST(GeometrySurface, NotFiniteComesBackUnchanged) {
  ReflectingSurface tank;
  tank.add_tank(unit_box, 3);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto r = tank.reflect({{0.5, 0.5, 0.5}}, {{nan, 0.5, 0.5}}, {});
  // The engine's own check must see the NaN.
  EXPECT_TRUE(std::isnan(r.position[0]));
  EXPECT_TRUE(r.stopped);
}

TEST(GeometrySurface, RefusesNonsense) {
  // One message for each.
  EXPECT_NE(sample::error_of([] { parse_faces({"top"}); }).find("unknown face 'top'"), std::string::npos);
  ReflectingSurface walls;
  EXPECT_NE(sample::error_of([&] { walls.add_plane({}, {{1}}, 1.5); }).find("restitution"), std::string::npos);
}

// Criterion: a wall that was placed mirrors as one that was built there, to 1e-12, in its own frame of velocity.
RC_GTEST_PROP(GeometrySurface, PlacedWallsMirrorWhereTheyAre, ()) {
  const Vec3 offset = sample::point(-1, 1), speed = sample::point(-2, 2);
  ReflectingSurface here = all_walls()[0].walls, there;
  here.place(0, offset, speed);
  there.add_tank({offset + unit_box.lo, offset + unit_box.hi}, 3);
  const Vec3 from = offset + sample::point(0, 1), step = sample::point(-2, 2);
  RC_PRE(there.depth(from) > 1e-9);
  const auto a = here.reflect(from, from + step, step + speed), b = there.reflect(from, from + step, step);
  RC_ASSERT(norm(a.position - b.position) <= 1e-11);
  RC_ASSERT(norm(a.velocity - speed - b.velocity) <= 1e-11);
  RC_ASSERT(here.clear(from, from + step) == there.clear(from, from + step));
  RC_ASSERT(std::abs(here.depth(from) - there.depth(from)) <= 1e-12);
}

// Criterion: a particle at rest that a wall runs over is thrown ahead with twice the wall's speed, as far ahead of the
// wall as it was behind.
TEST(GeometrySurface, AMovingWallThrowsWhatItOvertakes) {
  ReflectingSurface walls;
  walls.add_tank(unit_box, 3);
  walls.place(0, {{0.1, 0, 0}}, {{5, 0, 0}});
  const Vec3 at{{0.04, 0.5, 0.5}};
  const auto r = walls.reflect(at, at, {});
  EXPECT_NEAR(r.position[0], 0.16, 1e-9);
  EXPECT_NEAR(r.position[1], 0.5, 1e-12);
  EXPECT_NEAR(r.velocity[0], 10, 1e-12);
  EXPECT_EQ(r.velocity[1], 0);
}

// Criterion: pushed out of the corner of a box by both walls, to 1e-12; untouched where far from walls.
TEST(GeometrySurface, PushesOutToADistance) {
  ReflectingSurface walls;
  walls.add_tank(unit_box, 3);
  const Vec3 corner = walls.pushed_out({{0.1, 0.05, 0.5}}, 0.2);
  EXPECT_NEAR(norm(corner - Vec3{{0.2, 0.2, 0.5}}), 0, 1e-12);
  EXPECT_NEAR(norm(walls.pushed_out({{-0.1, 0.5, 0.5}}, 0.2) - Vec3{{0.2, 0.5, 0.5}}), 0, 1e-12);
  EXPECT_EQ(norm(walls.pushed_out({{0.3, 0.4, 0.5}}, 0.2) - Vec3{{0.3, 0.4, 0.5}}), 0);
}

}  // namespace
}  // namespace undine
