#include "undine/geometry/mesh.hpp"

#include <cstring>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "sample_shapes.hpp"
#include "undine/geometry/bvh.hpp"
#include "undine/geometry/fill.hpp"

namespace undine {
namespace {

using sample::error_of;
using sample::TemporaryFile;

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(GeometryMesh, RotatedCubeRoundTrip) {
  const auto cube = sample::map_points(sample::cube(), sample::rotated);
  for (const auto format : {StlFormat::ascii, StlFormat::binary}) {
    const TemporaryFile file("cube.stl");
    write_stl(cube, file.path(), format);
    const auto mesh = load_stl(file.path());
    // Welding restores 8 corners and 12 triangles; the volume is 1 to the rounding of float.
    EXPECT_EQ(mesh.vertices.size(), 8u);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_NEAR(signed_volume(mesh), 1, format == StlFormat::ascii ? 1e-12 : 1e-6);
    EXPECT_NO_THROW(check_watertight(mesh));
    const double spacing = 0.04;
    const auto points = fill_lattice(*make_mesh(mesh), {.spacing = spacing});
    // The count's error is that of the surface cells: below 1 %.
    EXPECT_NEAR(static_cast<double>(points.size()) * spacing * spacing * spacing, 1, 1e-2);
  }
}

TEST(GeometryMesh, InwardCubeIsTurnedAndScaled) {
  auto cube = sample::cube();
  for (auto& t : cube.triangles) std::swap(t[0], t[1]);
  const TemporaryFile file("inward.stl");
  write_stl(cube, file.path(), StlFormat::binary);
  // Volume of a cube of 2 m, positive.
  EXPECT_NEAR(signed_volume(load_stl(file.path(), 2)), 8, 1e-6);
}

TEST(GeometryMesh, MissingTriangleNamesTheRim) {
  auto cube = sample::cube();
  cube.triangles.pop_back();
  cube.source = "cube.stl";
  const auto text = error_of([&] { make_mesh(cube); });
  // The hole has three open edges with corners (0,1,0), (0,0,1), (0,1,1).
  EXPECT_TRUE(says(text, "3 open edges around 1 hole")) << text;
  EXPECT_TRUE(says(text, "(0, 1, 0)") && says(text, "(0, 0, 1)") && says(text, "(0, 1, 1)")) << text;
  EXPECT_TRUE(says(text, "cube.stl")) << text;
}

TEST(GeometryMesh, BadEdgesAreTold) {
  auto flipped = sample::cube();
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  // One triangle the wrong way round disagrees along its three edges.
  EXPECT_TRUE(says(error_of([&] { check_watertight(flipped); }), "3 edges join triangles that face opposite ways"));
  auto doubled = sample::cube();
  doubled.triangles.push_back(doubled.triangles[0]);
  // A triangle given twice: three edges join three.
  EXPECT_TRUE(says(error_of([&] { check_watertight(doubled); }), "3 edges join more than two triangles"));
}

TEST(GeometryMesh, DamagedBinaryFiles) {
  const TemporaryFile file("damaged.stl");
  write_stl(sample::cube(), file.path(), StlFormat::binary);
  const std::string good = read_bytes(file.path());
  const auto outcome = [&](const std::string& bytes) {
    file.write(bytes);
    return error_of([&] { load_stl(file.path()); });
  };
  std::string solid = good;
  std::memcpy(solid.data(), "solid facet", 11);
  // A header that starts with "solid" does not make a binary file ASCII.
  EXPECT_EQ(outcome(solid), "");
  // Each kind of damage is told with what was found.
  EXPECT_TRUE(says(outcome(good.substr(0, 300)), "promises 12 triangles"));
  EXPECT_TRUE(says(outcome(good.substr(0, 40)), "less than the header"));
  EXPECT_TRUE(says(outcome(""), "0 bytes"));
  std::string absurd = good;
  std::memset(absurd.data() + 80, 0xff, 4);
  EXPECT_TRUE(says(outcome(absurd), "promises 4294967295 triangles"));
  std::string nan = good;
  const float bad = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(nan.data() + 84 + 50 * 2 + 12, &bad, 4);
  EXPECT_TRUE(says(outcome(nan), "triangle 3 of 12 has a coordinate that is not a finite number"));
  std::string flat = good;
  std::memcpy(flat.data() + 84 + 12, flat.data() + 84 + 24, 12);
  EXPECT_TRUE(says(outcome(flat), "triangle 1 of 12 is degenerate"));
  std::string none = good.substr(0, 84);
  std::memset(none.data() + 80, 0, 4);
  EXPECT_TRUE(says(outcome(none), "no triangles"));
  EXPECT_TRUE(says(error_of([] { load_stl("/nowhere/at/all.stl"); }), "/nowhere/at/all.stl"));
}

TEST(GeometryMesh, DamagedAsciiFilesNameTheLine) {
  const TemporaryFile file("ascii.stl");
  write_stl(sample::cube(), file.path(), StlFormat::ascii);
  const std::string good = read_bytes(file.path());
  const auto outcome = [&](const std::string& bytes) {
    file.write(bytes);
    return error_of([&] { load_stl(file.path()); });
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  // Line 4 holds the first vertex, line 2 the first facet.
  EXPECT_TRUE(says(outcome(with("vertex", "vortex")), "ascii.stl:4: 'vortex' stands where 'vertex' belongs"));
  EXPECT_TRUE(says(outcome(with("vertex 0", "vertex nan")), "ascii.stl:2: triangle 1 has a coordinate"));
  EXPECT_TRUE(says(outcome(with("vertex 0", "vertex 0,5")), "'0,5' stands where 'a number' belongs"));
  EXPECT_TRUE(says(outcome(good.substr(0, good.size() / 2)), "ends too early"));
  EXPECT_TRUE(says(outcome(good.substr(0, good.rfind("endsolid"))), "ends too early"));
  EXPECT_TRUE(says(outcome("hello"), "5 bytes"));
  // Missing normals, capitals and Windows line ends are read.
  EXPECT_EQ(outcome(with("normal 0 0 -1", "normal nan nan nan")), "");
  EXPECT_EQ(outcome(with("outer loop\n", "OUTER LOOP\r\n")), "");
}

TEST(GeometryBvh, FirstHitOfCube) {
  const Bvh tree(sample::cube());
  const auto hit = tree.first_hit({{0.25, 0.5, -1}}, {{0.25, 0.5, 3}});
  ASSERT_TRUE(hit.has_value());
  // Enters z = 0 a quarter along the way, with the normal against the motion.
  EXPECT_NEAR(hit->fraction, 0.25, 1e-15);
  EXPECT_NEAR(hit->normal[2], -1, 1e-15);
  // Leaving: z = 1, half-way.
  const auto out = tree.first_hit({{0.25, 0.5, -1}}, {{0.25, 0.5, 3}}, Facing::leaving);
  ASSERT_TRUE(out.has_value());
  EXPECT_NEAR(out->fraction, 0.5, 1e-15);
  EXPECT_NEAR(out->normal[2], -1, 1e-15);
  EXPECT_FALSE(tree.first_hit({{2, 0.5, -1}}, {{2, 0.5, 3}}).has_value());
}

RC_GTEST_PROP(GeometryBvh, RaysThroughEdgesAndCornersDoNotSlipThrough, ()) {
  static const auto mesh = sample::map_points(sample::ball(2), sample::rotated);
  static const Bvh tree(mesh);
  const auto& t = mesh.triangles[sample::index(static_cast<int>(mesh.triangles.size()))];
  const double part = sample::number(0, 1);
  const Vec3 aim = (1 - part) * mesh.vertices[t[0]] + part * mesh.vertices[t[1]];
  const Vec3 from = 0.5 * sample::point(-1, 1);
  const Vec3 to = from + 4 * (aim - from);
  RC_PRE(norm(from) < 0.6);
  // From inside a closed surface every long ray leaves, also exactly through an edge or a corner.
  RC_ASSERT(tree.first_hit(from, to, Facing::leaving).has_value());
}

RC_GTEST_PROP(GeometryBvh, InsideAgreesWithTheSphereAndTheSign, ()) {
  static const auto mesh = sample::ball(3);
  static const Bvh tree(mesh);
  const Vec3 p = sample::point(-1.1, 1.1);
  // The facets of the ball lie between radius 0.985 and 1.
  if (norm(p) < 0.98) RC_ASSERT(tree.inside(p));
  if (norm(p) > 1) RC_ASSERT(!tree.inside(p));
  RC_ASSERT(tree.inside(p) == (tree.signed_distance(p) < 0) || tree.distance(p) < 1e-12);
  // The nearest point by brute force: no vertex is nearer, and the distance is that of the point named.
  const auto near = tree.closest(p);
  for (const Vec3& v : mesh.vertices) RC_ASSERT(norm(v - p) >= near.distance - 1e-12);
  RC_ASSERT(std::abs(norm(near.point - p) - near.distance) < 1e-12);
}

TEST(GeometryBvh, InsideOnLatticesThroughEdges) {
  const Bvh tree(sample::ell());
  // Points whose axis-parallel rays run along faces, edges and diagonals; the L is known exactly.
  for (int i = -1; i <= 9; ++i) {
    for (int j = -1; j <= 9; ++j) {
      const Vec3 p{{0.25 * i + 0.125, 0.25 * j + 0.125, 0.5}};
      const bool in = p[0] > 0 && p[1] > 0 && ((p[0] < 2 && p[1] < 1) || (p[0] < 1 && p[1] < 2));
      EXPECT_EQ(tree.inside(p), in);
    }
  }
}

}  // namespace
}  // namespace undine
