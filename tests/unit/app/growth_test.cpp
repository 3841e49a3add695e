#include "undine/app/growth.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace undine {

// Criterion: the power of a power law, whatever its factor; nearly that if it wavers; none where there is none.
TEST(Growth, IsThePowerOfAPowerLaw) {
  const std::vector<double> n{1000, 3000, 10000, 70000};
  std::vector<double> y, wavy;
  for (std::size_t k = 0; k < n.size(); ++k) {
    y.push_back(7e-9 * std::pow(n[k], 1.5));
    wavy.push_back(y.back() * (k % 2 ? 1.1 : 0.9));
  }
  EXPECT_NEAR(growth_exponent(n, y), 1.5, 1e-12);
  EXPECT_NEAR(growth_exponent(n, wavy), 1.5, 0.05);
  EXPECT_NEAR(growth_exponent(n, std::vector<double>(4, 3.0)), 0, 1e-12);
  EXPECT_TRUE(std::isnan(growth_exponent(n, std::vector<double>(4, 0.0))));
  EXPECT_TRUE(std::isnan(growth_exponent(std::vector<double>{5}, std::vector<double>{1})));
  EXPECT_TRUE(std::isnan(growth_exponent(std::vector<double>{5, 5}, std::vector<double>{1, 2})));
}

}  // namespace undine
