// The example of docs/approximation.md, word for word between the two lines of dashes.
#include <cmath>

#include <gtest/gtest.h>

// --------
#include "undine/approximation/approximation.hpp"

double laplacian_at_the_corner() {
  using namespace undine;
  using namespace undine::approximation;

  Points<2> points;  // a lattice of 20 x 20 points, 0.05 m apart
  std::vector<double> u;
  for (int i = 0; i < 400; ++i) {
    const Vec<2> x{{0.05 * (i % 20), 0.05 * (i / 20)}};
    points.x.push_back(x);
    u.push_back(std::sin(x[0]) * std::exp(x[1]));
  }
  const Approximation<2> by(points, {.method = "finite_point", .order = 2, .support = 0.16});
  const std::vector<Vec<2>> queries{{{0, 0}}, {{0.5, 0.5}}, {{3, 3}}};
  const Estimates<2> found = by.evaluate(queries, {u});

  if (found.status[2] != Status::no_neighbours) return 1;  // (3, 3) is out of reach
  return found.fields[0][0].laplacian();                   // of field 0 at query 0; .value and .gradient beside it
}
// --------

TEST(ApproximationExample, FindsTheLaplacianOfAHarmonicFunction) {
  EXPECT_NEAR(laplacian_at_the_corner(), 0, 0.2);
  EXPECT_NE(laplacian_at_the_corner(), 0);
}
