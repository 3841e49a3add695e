#include "undine/analysis/growth.hpp"

#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace undine {

TEST(Slope, OfALineAndOfTooFewPoints) {
  EXPECT_NEAR(slope(std::vector<double>{0, 1, 2}, std::vector<double>{5, 3, 1}), -2, 1e-15);
  EXPECT_TRUE(std::isnan(slope(std::vector<double>{}, std::vector<double>{})));
  EXPECT_TRUE(std::isnan(slope(std::vector<double>{1}, std::vector<double>{1})));
  EXPECT_TRUE(std::isnan(slope(std::vector<double>{2, 2}, std::vector<double>{1, 3})));
}

RC_GTEST_PROP(Growth, IsThePowerOfAPowerLaw, ()) {
  const double p = *rc::gen::inRange(-30, 41) / 10.0, C = *rc::gen::inRange(1, 1000) / 10.0;
  std::vector<double> x, y;
  for (int k = 0; k < *rc::gen::inRange(2, 8); ++k) {
    x.push_back(std::pow(0.7, k));
    y.push_back(C * std::pow(x.back(), p));
  }
  RC_ASSERT(std::abs(growth_exponent(x, y) - p) < 1e-9);
}

// Errors C h^2 (1 +- 10 %), alternately: between the orders of neighbours, by the least-squares line.
TEST(Growth, FitsAllPoints) {
  const std::vector<double> h{1, 0.5, 0.25, 0.125}, error{1.1, 0.225, 0.06875, 0.0140625};
  double xy = 0, xx = 0;
  const double x[] = {1.5, 0.5, -0.5, -1.5};
  for (std::size_t k = 0; k < 4; ++k) {
    xy += x[k] * std::log2(error[k]);
    xx += x[k] * x[k];
  }
  EXPECT_NEAR(growth_exponent(h, error), xy / xx, 1e-12);
}

// Criterion: 0 for what does not grow; nothing where there is no power.
TEST(Growth, OfConstantsAndOfWhatHasNone) {
  const std::vector<double> n{1000, 3000, 10000, 70000};
  EXPECT_NEAR(growth_exponent(n, std::vector<double>(4, 3.0)), 0, 1e-12);
  EXPECT_TRUE(std::isnan(growth_exponent(n, std::vector<double>(4, 0.0))));
  EXPECT_TRUE(std::isnan(growth_exponent(std::vector<double>{5}, std::vector<double>{1})));
  EXPECT_TRUE(std::isnan(growth_exponent(std::vector<double>{5, 5}, std::vector<double>{1, 2})));
}

}  // namespace undine
