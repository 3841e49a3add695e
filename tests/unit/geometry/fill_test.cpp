#include "undine/geometry/fill.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "sample_shapes.hpp"
#include "undine/geometry/points.hpp"

namespace undine {
namespace {

using sample::error_of;

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(GeometryFill, BoxCountsAreRounded) {
  for (const double spacing : {0.1, 0.02, 1.0 / 3, 0.03, 0.07}) {
    for (const double length : {1.0, 0.7, 2.1, 0.3 + 0.6}) {
      const auto box = make_box({{-0.3, 0, 0}}, {{-0.3 + length, 1, 1}}, 2);
      const auto nx = std::lround(length / spacing);
      const auto ny = std::lround(1 / spacing);
      const auto points = fill_lattice(*box, {.spacing = spacing, .dimensions = 2});
      // round(L / spacing) along each axis, whatever the rounding of the coordinates.
      EXPECT_EQ(points.size(), static_cast<std::size_t>(nx * ny)) << spacing << " " << length;
      // The first point is half a spacing from the lower faces.
      EXPECT_NEAR(points.front()[0], -0.3 + spacing / 2, 1e-14);
      EXPECT_NEAR(points.front()[1], spacing / 2, 1e-14);
      EXPECT_EQ(points.front()[2], 0);
    }
  }
  // 1-D and 3-D.
  EXPECT_EQ(fill_lattice(*make_box({{0}}, {{1}}, 1), {.spacing = 0.01, .dimensions = 1}).size(), 100u);
  EXPECT_EQ(fill_lattice(*make_box({}, {{1, 0.5, 0.2}}), {.spacing = 0.1}).size(), 100u);
}

TEST(GeometryFill, AdjoiningShapesShareNoPoints) {
  const Vec3 anchor{{0.05, 0, 0}};
  const auto left = fill_lattice(*make_box({}, {{0.5, 1}}, 2), {.spacing = 0.1, .dimensions = 2, .anchor = anchor});
  const auto right =
      fill_lattice(*make_box({{0.5, 0}}, {{1, 1}}, 2), {.spacing = 0.1, .dimensions = 2, .anchor = anchor});
  // Lattice points lie exactly on x = 0.5: in one of the two, so 10 columns of 10 in all, none twice.
  EXPECT_EQ(left.size() + right.size(), 100u);
  EXPECT_FALSE(check_overlap(left, right, 0.05).has_value());
}

TEST(GeometryFill, HexagonalKeepsTheVolumePerPoint) {
  for (const int dimensions : {2, 3}) {
    const auto points = fill_lattice(*make_box({}, {{1, 1, 1}}, dimensions),
                                     {.spacing = 0.02, .dimensions = dimensions, .kind = Lattice::hexagonal});
    // As many points as volume per spacing^dimensions, within the 3 % that the last rows may lack.
    EXPECT_NEAR(static_cast<double>(points.size()) * std::pow(0.02, dimensions), 1, 3e-2);
    const double nearest = dimensions == 2 ? std::sqrt(2 / std::sqrt(3.0)) : std::pow(2.0, 1.0 / 6);
    // Nearest neighbours at the lattice's distance: none nearer, some just there.
    EXPECT_FALSE(check_overlap(points, 0.02 * nearest * (1 - 1e-9)).has_value());
    EXPECT_TRUE(check_overlap(points, 0.02 * nearest * (1 + 1e-9)).has_value());
  }
}

TEST(GeometryFill, ShellOfAClosedBox) {
  const auto box = make_box({}, {{1, 1, 1}});
  // One layer outside, edges and corners filled: 52^3 - 50^3.
  EXPECT_EQ(fill_shell(*box, {.spacing = 0.02}).size(), 52u * 52 * 52 - 50u * 50 * 50);
  // One layer inside: 50^3 - 48^3; three layers outside: 56^3 - 50^3.
  EXPECT_EQ(fill_shell(*box, {.spacing = 0.02, .side = Side::inside}).size(), 50u * 50 * 50 - 48u * 48 * 48);
  EXPECT_EQ(fill_shell(*box, {.spacing = 0.02, .layers = 3}).size(), 56u * 56 * 56 - 50u * 50 * 50);
  // Without a lid the layer above is gone: 52 * 52 points fewer.
  const ShellSpec open{.spacing = 0.02, .open = parse_faces({"z+"})};
  EXPECT_EQ(fill_shell(*box, open).size(), 52u * 52 * 51 - 50u * 50 * 50);
  // In 2-D: 12 * 12 - 10 * 10.
  EXPECT_EQ(fill_shell(*make_box({}, {{1, 1}}, 2), {.spacing = 0.1, .dimensions = 2}).size(), 44u);
  const auto wall = fill_shell(*box, {.spacing = 0.02, .layers = 2});
  const auto fluid = fill_lattice(*box, {.spacing = 0.02});
  // Fluid and wall form one lattice: nearest distance one spacing.
  const auto nearest = check_overlap(wall, fluid, 0.03);
  ASSERT_TRUE(nearest.has_value());
  EXPECT_NEAR(nearest->distance, 0.02, 1e-12);
}

TEST(GeometryFill, ShellOfASphere) {
  const auto sphere = make_sphere({}, 1);
  const auto wall = fill_shell(*sphere, {.spacing = 0.05, .layers = 3});
  const double volume = 4.0 / 3 * std::numbers::pi * (cube(1.15) - 1);
  // The volume of the layer, to 2 %, and every point within it.
  EXPECT_NEAR(static_cast<double>(wall.size()) * cube(0.05) / volume, 1, 2e-2);
  for (const Vec3& p : wall) EXPECT_TRUE(norm(p) > 1 - 1e-6 && norm(p) < 1.15 + 1e-6);
}

TEST(GeometryFill, GoettingenSheets) {
  const Bounds box{{{0, 0, 0}}, {{1, 1, 1}}};
  const auto points = fill_face_sheet(box, {.spacing = 0.02});
  // Six faces of 50 x 50, each exactly on its face.
  EXPECT_EQ(points.size(), 15'000u);
  for (const Vec3& p : points) {
    int on = 0;
    for (int k = 0; k < 3; ++k) on += p[k] == 0 || p[k] == 1;
    EXPECT_EQ(on, 1);
  }
  EXPECT_EQ(fill_face_sheet(box, {.spacing = 0.02, .open = parse_faces({"z+"})}).size(), 12'500u);
}

TEST(GeometryFill, RefusesTheImpossible) {
  const auto of = [](const ShapePtr& shape, double spacing) {
    return error_of([&] { fill_lattice(*shape, {.spacing = spacing}); });
  };
  // Each message names the reason.
  EXPECT_TRUE(says(of(make_half_space({}, {{1, 0, 0}}), 0.1), "without end along x"));
  EXPECT_TRUE(says(of(make_box({}, {{1, 1, 1}}), 1e-6), "far too small"));
  EXPECT_TRUE(says(of(make_box({}, {{1, 1, 1}}), 0), "above 0"));
  EXPECT_TRUE(says(error_of([] { fill_shell(*make_sphere({}, 1), {.spacing = 0.1, .open = parse_faces({"x-"})}); }),
                   "only a box"));
}

TEST(GeometryPoints, CsvIsReadByName) {
  const sample::TemporaryFile file("points.csv");
  file.write("\xef\xbb\xbf# a comment\r\nx, y ,vx,rho\r\n0.5,1e-1,+2,1000\n\n-1,2,3,4\n");
  const auto table = load_points_csv(file.path(), 2);
  ASSERT_EQ(table.points.size(), 2u);
  // The values as written.
  EXPECT_EQ(table.points[0], (Vec3{{0.5, 0.1, 0}}));
  EXPECT_EQ(*table.find("vx"), (std::vector<double>{2, 3}));
  EXPECT_EQ(*table.find("rho"), (std::vector<double>{1000, 4}));
  EXPECT_EQ(table.find("vy"), nullptr);
}

TEST(GeometryPoints, CsvErrorsNameTheLine) {
  const sample::TemporaryFile file("bad.csv");
  const auto of = [&](const std::string& text, int dimensions = 2) {
    file.write(text);
    return error_of([&] { load_points_csv(file.path(), dimensions); });
  };
  // File, line and, where it applies, column.
  EXPECT_TRUE(says(of("x,y\n1,2\n1,two\n"), "bad.csv:3:2: 'two' is not a finite number"));
  EXPECT_TRUE(says(of("x,y\n1,nan\n"), "bad.csv:2:2"));
  EXPECT_TRUE(says(of("x,y\n1,2,3\n"), "bad.csv:2: the line has 3 fields"));
  EXPECT_TRUE(says(of("x,vx\n1,2\n"), "column 'y' is missing"));
  EXPECT_TRUE(says(of("x,y,x\n"), "bad.csv:1:3: column 'x' is named twice"));
  EXPECT_TRUE(says(of("0.1,0.2\n"), "'0.1' is not a name"));
  EXPECT_TRUE(says(of("x,y,z\n1,2,3\n"), "z is 3"));
  EXPECT_TRUE(says(of("x,y\n"), "no particles"));
  EXPECT_TRUE(says(of(""), "empty"));
}

TEST(GeometryPoints, ClosestPairMatchesBruteForce) {
  std::vector<Vec3> a, b;
  unsigned seed = 1;
  const auto next = [&] { return (seed = seed * 1664525u + 1013904223u) / 4294967296.0 - 0.5; };
  for (int i = 0; i < 300; ++i) {
    a.push_back({{next(), next(), next()}});
    b.push_back({{next(), next(), next()}});
  }
  double least = 1;
  for (const Vec3& p : a) {
    for (const Vec3& q : b) least = std::min(least, norm(p - q));
  }
  const auto found = check_overlap(a, b, 0.5);
  ASSERT_TRUE(found.has_value());
  // Exactly the distance of the brute-force search, and of the pair named.
  EXPECT_DOUBLE_EQ(found->distance, least);
  EXPECT_DOUBLE_EQ(norm(a[found->a] - b[found->b]), least);
  EXPECT_FALSE(check_overlap(a, b, 0.99 * least).has_value());
}

}  // namespace
}  // namespace undine
