#include "undine/walls/mirrors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "undine/core/error.hpp"

// Where ghosts lie: the images in corners, and that every place of a wall is filled once with fluid from before it.

namespace undine::walls {
namespace {

template <int N>
Domain<N> cube(double low, double high) {
  Domain<N> domain;
  for (int k = 0; k < N; ++k) domain.low[k] = low, domain.high[k] = high;
  return domain;
}

template <int N>
Plane<N> plane(int axis, double at, double into_fluid) {
  Plane<N> face;
  face.normal[axis] = into_fluid;
  face.offset = into_fluid * at;
  return face;
}

/// The walls of a box with the fluid inside; one solid for each face.
template <int N>
std::vector<Solid<N>> tank(double low, double high) {
  std::vector<Solid<N>> solids;
  for (int k = 0; k < N; ++k) {
    solids.push_back({.faces = {plane<N>(k, low, 1)}, .name = "tank"});
    solids.push_back({.faces = {plane<N>(k, high, -1)}, .name = "tank"});
  }
  return solids;
}

/// A box with the fluid outside.
template <int N>
Solid<N> block(const Vec<N>& low, const Vec<N>& high) {
  Solid<N> solid{.faces = {}, .name = "block"};
  for (int k = 0; k < N; ++k) {
    solid.faces.push_back(plane<N>(k, low[k], -1));
    solid.faces.push_back(plane<N>(k, high[k], 1));
  }
  return solid;
}

template <int N>
std::vector<typename Mirrors<N>::Image> images(const Mirrors<N>& mirrors, const Vec<N>& x, double reach) {
  std::vector<typename Mirrors<N>::Image> found;
  mirrors.images(x, reach, found);
  return found;
}

template <int N>
bool contains(const std::vector<typename Mirrors<N>::Image>& found, const Vec<N>& x) {
  return std::ranges::any_of(found, [&](const auto& image) { return norm(image.x - x) < 1e-14; });
}

TEST(Mirrors, ThreeGhostsInACornerOfAPlane) {
  const Mirrors<2> mirrors(tank<2>(0, 10), Slip::free, 1, cube<2>(-1, 11));
  const auto found = images<2>(mirrors, {{0.25, 0.5}}, 1);
  ASSERT_EQ(found.size(), 3);
  EXPECT_TRUE(contains<2>(found, {{-0.25, 0.5}}));
  EXPECT_TRUE(contains<2>(found, {{0.25, -0.5}}));
  EXPECT_TRUE(contains<2>(found, {{-0.25, -0.5}}));
  // Two mirror images, and no point image that lies deeper than the reach.
  EXPECT_EQ(images<2>(mirrors, {{0.8, 0.8}}, 1).size(), 2);
  EXPECT_EQ(images<2>(mirrors, {{5, 0.5}}, 1).size(), 1);
  EXPECT_EQ(images<2>(mirrors, {{5, 5}}, 1).size(), 0);
  EXPECT_EQ(images<2>(mirrors, {{9.5, 9.5}}, 1).size(), 3);
}

TEST(Mirrors, SevenGhostsInACornerOfSpace) {
  const Mirrors<3> mirrors(tank<3>(0, 10), Slip::free, 1, cube<3>(-1, 11));
  EXPECT_EQ(mirrors.count(), 6 + 12 + 8);
  const Vec<3> x{{0.125, 0.25, 0.5}};
  const auto found = images<3>(mirrors, x, 1);
  ASSERT_EQ(found.size(), 7);
  for (int bits = 1; bits < 8; ++bits) {
    Vec<3> y = x;
    for (int k = 0; k < 3; ++k)
      if (bits & 1 << k) y[k] = -x[k];
    EXPECT_TRUE(contains<3>(found, y)) << bits;
  }
  EXPECT_EQ(images<3>(mirrors, {{5, 0.25, 0.5}}, 1).size(), 3);
}

// The velocities: reflections one after the other, or all of it, both relative to a wall that slides.
TEST(Mirrors, VelocitiesSlipOrNot) {
  auto solids = tank<2>(0, 10);
  for (auto& solid : solids) solid.velocity = {{0, 0.5}};
  const Vec<2> v{{3, 2}};
  for (const auto slip : {Slip::free, Slip::none}) {
    const Mirrors<2> mirrors(solids, slip, 1, cube<2>(-1, 11));
    for (const auto& image : images<2>(mirrors, {{0.25, 5}}, 1)) {
      const Vec<2> u = mirrors.mirror(image.mirror).velocity(v, slip);
      EXPECT_EQ(u[0], -3);
      EXPECT_EQ(u[1], slip == Slip::free ? 2 : -1);
    }
    for (const auto& image : images<2>(mirrors, {{0.25, 0.25}}, 1))
      if (mirrors.mirror(image.mirror).count == 2) {
        const Vec<2> u = mirrors.mirror(image.mirror).velocity(v, slip);
        EXPECT_EQ(u[0], -3);
        EXPECT_EQ(u[1], -1);
      }
  }
}

/// Cells of a unit lattice, points in their middles.
template <int N, class F>
void for_each_cell(int low, int high, F f) {
  Vec<N, int> cell;
  for (int k = 0; k < N; ++k) cell[k] = low;
  for (;;) {
    Vec<N> x;
    for (int k = 0; k < N; ++k) x[k] = cell[k] + 0.5;
    f(x);
    int axis = 0;
    for (; axis < N; ++axis) {
      if (++cell[axis] < high) break;
      cell[axis] = low;
    }
    if (axis == N) return;
  }
}

/// Distance of a point from the fluid, whose lattice cells are whole: the least over its cells.
template <int N>
double distance(const Vec<N>& x, const std::vector<Vec<N>>& fluid) {
  double least = 1e300;
  for (const auto& at : fluid) {
    double sum = 0;
    for (int k = 0; k < N; ++k) sum += sq(std::max(0.0, std::abs(x[k] - at[k]) - 0.5));
    least = std::min(least, sum);
  }
  return std::sqrt(least);
}

/// Criterion: with fluid on a unit lattice in [0, size]^N outside of the blocks, each lattice place of the walls that
/// is nearer than 3 to the fluid holds one ghost, no other place holds any, and none is in the fluid.
template <int N>
void expect_filled_once(std::vector<Solid<N>> solids, int size, double reach = 3) {
  const auto solid_at = [&](const Vec<N>& x) {
    return std::ranges::any_of(solids, [&](const auto& solid) {
      return std::ranges::all_of(solid.faces, [&](const auto& face) { return face.height(x) < 0; });
    });
  };
  const Mirrors<N> mirrors(solids, Slip::free, reach, cube<N>(-1, size + 1));
  std::vector<Vec<N>> fluid;
  std::map<std::vector<long>, int> ghosts;
  for_each_cell<N>(0, size, [&](const Vec<N>& x) {
    if (solid_at(x)) return;
    fluid.push_back(x);
    for (const auto& image : images<N>(mirrors, x, reach)) {
      EXPECT_TRUE(solid_at(image.x));
      std::vector<long> key;
      for (int k = 0; k < N; ++k) key.push_back(std::lround(2 * image.x[k]));
      ++ghosts[key];
    }
  });
  std::size_t places = 0;
  for_each_cell<N>(-4, size + 4, [&](const Vec<N>& x) {
    if (!solid_at(x)) return;
    const double depth = distance<N>(x, fluid);
    std::vector<long> key;
    for (int k = 0; k < N; ++k) key.push_back(std::lround(2 * x[k]));
    const auto at = ghosts.find(key);
    const int count = at == ghosts.end() ? 0 : at->second;
    EXPECT_EQ(count, depth < reach ? 1 : 0)
        << "at " << x[0] << ' ' << x[N > 1 ? 1 : 0] << ' ' << x[N - 1] << ", depth " << depth;
    places += count;
  });
  std::size_t all = 0;
  for (const auto& [key, count] : ghosts) all += count;
  EXPECT_EQ(all, places);
  EXPECT_GT(all, 0);
}

template <int N>
std::vector<Solid<N>> tank_with(std::vector<Solid<N>> blocks, int size) {
  auto solids = tank<N>(0, size);
  solids.insert(solids.end(), blocks.begin(), blocks.end());
  return solids;
}

TEST(Mirrors, EveryPlaceOfATankIsFilledOnce) {
  expect_filled_once<1>(tank<1>(0, 8), 8);
  expect_filled_once<2>(tank<2>(0, 8), 8);
  expect_filled_once<3>(tank<3>(0, 7), 7);
}

TEST(Mirrors, EveryPlaceOfAnObstacleIsFilledOnce) {
  const auto free_block = block<2>({{5, 6}}, {{13, 12}});
  expect_filled_once<2>(tank_with<2>({free_block}, 20), 20);
  const auto thin = block<2>({{5, 6}}, {{13, 10}});  // images from above and from below meet in its middle
  expect_filled_once<2>(tank_with<2>({thin}, 20), 20);
  const auto free_cube = block<3>({{4, 4, 4}}, {{9, 10, 9}});
  expect_filled_once<3>(tank_with<3>({free_cube}, 14), 14);
}

TEST(Mirrors, EveryPlaceOfAnObstacleOnAWallIsFilledOnce) {
  expect_filled_once<2>(tank_with<2>({block<2>({{6, 0}}, {{12, 5}})}, 18), 18);
  expect_filled_once<2>(tank_with<2>({block<2>({{6, -3}}, {{12, 5}})}, 18), 18);  // its foot in the floor
  expect_filled_once<2>(tank_with<2>({block<2>({{6, 0}}, {{12, 2}})}, 18), 18);   // lower than the reach
  expect_filled_once<2>(tank_with<2>({block<2>({{0, 0}}, {{6, 6}})}, 14), 14);    // in a corner
  expect_filled_once<2>(tank_with<2>({block<2>({{5, 0}}, {{9, 6}}), block<2>({{9, 0}}, {{13, 6}})}, 18), 18);  // flush
  expect_filled_once<3>(tank_with<3>({block<3>({{4, 0, 0}}, {{8, 6, 4}})}, 11), 11);
}

TEST(Mirrors, ObstaclesRepeatWithThePeriod) {
  Domain<2> domain = cube<2>(0, 20);
  domain.periodic[0] = true;
  const Mirrors<2> mirrors({block<2>({{2, 6}}, {{10, 14}})}, Slip::free, 3, domain);
  // From before the left face, by way of the other end of the period.
  const auto found = images<2>(mirrors, {{19.5, 10}}, 3);
  ASSERT_EQ(found.size(), 1);
  EXPECT_NEAR(found[0].x[0], 24.5, 1e-13);
  // A block as long as the period has no ends.
  const Mirrors<2> endless({block<2>({{0, 6}}, {{20, 14}})}, Slip::free, 3, domain);
  EXPECT_EQ(endless.count(), 2);
  EXPECT_EQ(images<2>(endless, {{0.5, 5}}, 3).size(), 1);
}

/// A floor and a slope that rises from x = 0 to the left; the fluid fills `degrees` between them.
std::vector<Solid<2>> wedge(double degrees) {
  const double angle = degrees * std::acos(-1.0) / 180;
  return {{.faces = {plane<2>(1, 0, 1)}, .name = "floor"},
          {.faces = {{.normal = {{std::sin(angle), -std::cos(angle)}}, .offset = 0}}, .name = "slope"}};
}

// Criterion: beyond an obtuse edge no two ghosts are nearer than 0.9 spacings of the fluid, none is in the fluid, and
// the fluid's volume goes on: where a kernel of radius 3 about the edge is cut, ghosts and fluid fill it to 2 %.
TEST(Mirrors, ObtuseEdgesAreFilled) {
  const auto solids = wedge(135);
  const Mirrors<2> mirrors(solids, Slip::free, 3.5, cube<2>(-20, 20));
  const double spacing = 0.05;
  double area = 0;
  for (int i = -200; i < 200; ++i)
    for (int j = 0; j < 200; ++j) {
      const Vec<2> x{{(i + 0.5) * spacing, (j + 0.5) * spacing}};
      if (solids[1].faces[0].height(x) <= 0) continue;
      if (norm(x) < 3) area += sq(spacing);
      for (const auto& image : images<2>(mirrors, x, 3.5)) {
        EXPECT_TRUE(solids[0].faces[0].height(image.x) < 0 || solids[1].faces[0].height(image.x) < 0);
        if (norm(image.x) < 3) area += sq(spacing);
      }
    }
  EXPECT_NEAR(area, 9 * std::acos(-1.0), 0.02 * 9 * std::acos(-1.0));
}

template <int N>
void expect_refused(const std::vector<Solid<N>>& solids, const std::string& words, Domain<N> domain = cube<N>(-9, 9)) {
  try {
    const Mirrors<N> mirrors(solids, Slip::free, 1, domain);
    FAIL() << "not refused: " << words;
  } catch (const InputError& error) {
    EXPECT_NE(error.parts().what.find(words), std::string::npos) << error.parts().what;
  }
}

TEST(Mirrors, WhatGhostsCannotDoIsRefused) {
  expect_refused<2>(wedge(60), "'floor' and 'slope' meet at 60 degrees");
  EXPECT_NO_THROW(Mirrors<2>(wedge(90), Slip::free, 1, cube<2>(-9, 9)));
  // The edge is out of the domain.
  auto away = wedge(60);
  away[1].faces[0].offset = -40;
  EXPECT_NO_THROW(Mirrors<2>(away, Slip::free, 1, cube<2>(-9, 9)));
  expect_refused<2>(tank<2>(0, 0.5), "are 0.5 m apart");
  expect_refused<2>({block<2>({{0, 0}}, {{5, 0.5}})}, "'block' is 0.5 m thick");
  auto on_floor = tank<2>(0, 8);
  on_floor.push_back(block<2>({{2, 0}}, {{5, 0.5}}));
  EXPECT_NO_THROW(Mirrors<2>(on_floor, Slip::free, 1, cube<2>(-9, 9)));
  auto periodic = cube<2>(0, 8);
  periodic.periodic[0] = true;
  expect_refused<2>(tank<2>(0, 8), "stands across the period along x", periodic);
}

}  // namespace
}  // namespace undine::walls
