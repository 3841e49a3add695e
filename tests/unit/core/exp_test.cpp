#include "undine/core/exp.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "undine/core/pack.hpp"

namespace undine {
namespace {

template <class T>
T exp_of(T x) {
  return exponential<T>(x);
}

/// The format's own limits: e^x is normal between `low` and `high`; `wide` is the next wider type.
template <class T>
struct Range;
template <>
struct Range<float> {
  static constexpr float low = -87.3f, high = 88.7f;
  using wide = double;
};
template <>
struct Range<double> {
  static constexpr double low = -708.3, high = 709.7;
  using wide = long double;
};

/// e^x rounded to T, and the error of `result` in units of its last place.
template <class T>
double error_in_ulp(T x, T result) {
  using Wide = typename Range<T>::wide;
  const Wide exact = std::exp(static_cast<Wide>(x));
  int exponent;
  std::frexp(static_cast<T>(exact), &exponent);
  const Wide ulp = std::ldexp(static_cast<Wide>(1), exponent - std::numeric_limits<T>::digits);
  return static_cast<double>(std::abs(static_cast<Wide>(result) - exact) / ulp);
}

template <class T>
class Exp : public testing::Test {};
using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(Exp, Numbers);

TYPED_TEST(Exp, IsWithinLittleMoreThanOneUlp) {
  using T = TypeParam;
  constexpr int samples = 2'000'000;
  const auto sample = [&](T from, T to) {
    double worst = 0;
    for (int k = 0; k <= samples; ++k) {
      const T x = from + (to - from) * (static_cast<T>(k) / T(samples));
      worst = std::max(worst, error_in_ulp(x, exp_of(x)));
    }
    return worst;
  };
  EXPECT_LE(sample(Range<T>::low, Range<T>::high), 1.1);
  EXPECT_LE(sample(-10, 1), 1.1);  // what kernels ask for
}

TYPED_TEST(Exp, IsExactAtZero) {
  using T = TypeParam;
  EXPECT_EQ(exp_of(T(0)), 1);
  EXPECT_EQ(exp_of(T(-0.0)), 1);
  EXPECT_EQ(exp_of(std::numeric_limits<T>::min()), 1);
  static_assert(exponential<T>(T(0)) == 1);
}

TYPED_TEST(Exp, UnderflowsThroughSubnormalNumbersToZero) {
  using T = TypeParam;
  constexpr T tiny = std::numeric_limits<T>::denorm_min();
  for (T x = Range<T>::low; x > T(1.1) * Range<T>::low; x -= T(0.01))
    EXPECT_LE(std::abs(exp_of(x) - std::exp(x)), tiny) << x;
  EXPECT_EQ(exp_of(T(1.25) * Range<T>::low), 0);
  EXPECT_EQ(exp_of(std::numeric_limits<T>::lowest()), 0);
  EXPECT_EQ(exp_of(-std::numeric_limits<T>::infinity()), 0);
}

TYPED_TEST(Exp, OverflowsToInfinity) {
  using T = TypeParam;
  constexpr T infinity = std::numeric_limits<T>::infinity();
  EXPECT_LT(exp_of(Range<T>::high), infinity);
  EXPECT_EQ(exp_of(Range<T>::high + 1), infinity);
  EXPECT_EQ(exp_of(std::numeric_limits<T>::max()), infinity);
  EXPECT_EQ(exp_of(infinity), infinity);
}

TYPED_TEST(Exp, OfNanIsNan) {
  using T = TypeParam;
  EXPECT_TRUE(std::isnan(exp_of(std::numeric_limits<T>::quiet_NaN())));
}

TYPED_TEST(Exp, PacksEqualNumbersLaneByLane) {
  using T = TypeParam;
  using V = Pack<T>;
  constexpr T infinity = std::numeric_limits<T>::infinity();
  // Compilers may join products and sums differently in the two: the last bit may differ.
  constexpr T last_bit = std::numeric_limits<T>::epsilon(), tiny = std::numeric_limits<T>::denorm_min();
  for (int k = 0; k < 100'000; ++k) {
    const auto x = [&](int lane) { return T(1.3) * Range<T>::low * (T(1) - T(2e-5) * (T(k) + T(0.03) * T(lane))); };
    const V got = exponential<T>(V::generate(x));
    for (int lane = 0; lane < V::lanes; ++lane) {
      const T wanted = exp_of(x(lane));
      ASSERT_TRUE(got[lane] == wanted || std::abs(got[lane] - wanted) <= last_bit * wanted + tiny) << x(lane);
    }
  }
  const T special[] = {-infinity, infinity, std::numeric_limits<T>::quiet_NaN(), 0};
  const V got = exponential<T>(V::generate([&](int lane) { return special[lane % 4]; }));
  for (int lane = 0; lane < V::lanes; ++lane) {
    const T wanted = exp_of(special[lane % 4]);
    EXPECT_TRUE(got[lane] == wanted || (std::isnan(wanted) && std::isnan(got[lane]))) << lane;
  }
}

}  // namespace
}  // namespace undine
