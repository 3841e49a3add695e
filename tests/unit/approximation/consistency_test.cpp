#include "undine/approximation/consistency.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "undine/approximation/catalogue.hpp"
#include "unit/under_sanitizer.hpp"

namespace undine::approximation {
namespace {

constexpr double exact = 1e-10;   ///< of the scale of the quantity: 1 for a value, 1/H and 1/H^2 for derivatives
constexpr double visible = 1e-5;  ///< an error that is not rounding
constexpr double slack = 0.5;     ///< of an observed order: tells k from k - 1

/// Exact up to the promised degree, and not beyond it: a method that promises too little is as wrong as one that
/// promises too much.
void expect_degree(const std::array<double, 3>& errors, int promised, double scale, bool may_be_better) {
  for (int d = 0; d <= 2; ++d) {
    const double error = errors[static_cast<std::size_t>(d)];
    if (promised == Degrees::not_given) {
      EXPECT_TRUE(std::isnan(error)) << "degree " << d << " is given";
    } else if (d <= promised) {
      EXPECT_LE(error, exact * scale) << "degree " << d;
    } else if (!may_be_better) {
      EXPECT_GE(error, visible) << "degree " << d << " is exact too";
    }
  }
}

template <int N>
void expect_all_promises_kept() {
  const StudyOptions options;
  const double H = options.support / (N == 1 ? 32 : N == 2 ? 20 : 12);
  const auto rows = consistency_study<N>(options);
  std::size_t combinations = 0;
  Methods::for_each([&]<class M>(M) { combinations += 1 + M::highest_order - M::lowest_order; });
  ASSERT_EQ(rows.size(), 4 * combinations);
  for (const StudyRow& row : rows) {
    SCOPED_TRACE(testing::Message() << row.method << " order " << row.order << " in " << N << "-D, "
                                    << arrangement_words[static_cast<int>(row.arrangement)] << ", "
                                    << place_words[static_cast<int>(row.place)]);
    const bool regular = row.arrangement == Arrangement::regular;  // symmetry cancels errors
    EXPECT_EQ(row.refused, 0);
    EXPECT_GE(row.condition, 1);
    EXPECT_LE(row.condition, 1e8);
    expect_degree(row.value, row.promised.value, 1, regular);
    expect_degree(row.gradient, row.promised.gradient, 1 / H, regular);
    expect_degree(row.hessian, row.promised.hessian, 1 / sq(H), regular);
    // What is exact to degree k converges with order k + 1; each derivative takes one.
    // Multiquadrics alone nearly reproduce linear fields, so that their second-order error hides the one of first
    // order.
    if (regular || (row.method == "radial_point_interpolation" && row.order == 0)) continue;
    if (row.promised.value >= 0) {
      EXPECT_GE(row.value_order, row.promised.value + 1 - slack);
    }
    if (row.promised.gradient >= 1) {
      EXPECT_GE(row.gradient_order, row.promised.gradient - slack);
    }
    if (row.promised.hessian >= 2) {
      EXPECT_GE(row.laplacian_order, row.promised.hessian - 1 - slack);
    }
  }
}

TEST(Consistency, IsAsPromisedInOneDimension) { expect_all_promises_kept<1>(); }
TEST(Consistency, IsAsPromisedInTwoDimensions) { expect_all_promises_kept<2>(); }
TEST(Consistency, IsAsPromisedInThreeDimensions) {
  if (test::under_sanitizer) GTEST_SKIP() << "takes minutes there, and the loops are those of two dimensions";
  expect_all_promises_kept<3>();
}

/// At the end of a row of points half of the kernel is cut off: SPH finds half of a constant, and does not get better
/// with more points. Niedoba (2012), figure 2.8.
TEST(Consistency, SphLosesHalfOfAConstantAtTheBoundary) {
  for (const EndRow& row : end_of_support({}, "sph", 0)) {
    SCOPED_TRACE(row.distance);
    if (row.distance == 0) {
      EXPECT_NEAR(row.one, 0.5, 0.01);
      EXPECT_GT(row.gradient_of_one, 1);
      EXPECT_NEAR(row.gradient_of_x, 0.5, 0.05);
    }
    if (row.distance > 0.75) {
      EXPECT_NEAR(row.one, 1, 0.005);
    }
  }
  for (const EndRow& row : end_of_support({}, "shepard", 0)) {
    EXPECT_NEAR(row.one, 1, 1e-14);
    if (row.distance < 0.05) {
      EXPECT_GT(row.x_error, 0.1);
    }
  }
  for (const EndRow& row : end_of_support({}, "rkpm", 1)) {
    EXPECT_NEAR(row.one, 1, 1e-13);
    EXPECT_NEAR(row.x_error, 0, 1e-13);
    EXPECT_NEAR(row.gradient_of_x, 1, 1e-12);
  }
  int rows = 0;
  for (const StudyRow& row : consistency_study<1>({}, "sph", 0)) {
    if (row.place != Place::boundary) continue;
    ++rows;
    EXPECT_GT(row.value[0], 0.3);
    EXPECT_LT(row.value_order, 0.2);
    EXPECT_LT(row.gradient_order, -0.8);
  }
  EXPECT_EQ(rows, 2);
}

}  // namespace
}  // namespace undine::approximation
