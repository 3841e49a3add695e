#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "undine/app/study/quantity.hpp"
#include "undine/app/study/verdict.hpp"
#include "undine/io/case/document.hpp"

namespace undine::study {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Document document(const std::string& text) { return Document::parse(text, "study.toml"); }

Quantity quantity(const std::string& keys) {
  const Document file = document("name = \"q\"\ncolumn = \"v\"\n" + keys);
  return read_quantity(file.root(), {});
}

/// f at 0, 0.01, ..., 1 s.
double take(const std::string& keys, double (*f)(double)) {
  std::vector<double> times, values;
  for (int k = 0; k <= 100; ++k) {
    times.push_back(0.01 * k);
    values.push_back(f(0.01 * k));
  }
  return take_from(quantity(keys), times, values);
}

double line(double t) { return 3 + 2 * t; }
double hat(double t) { return 1 - std::abs(2 * t - 1); }  // 0 at the ends, 1 at 0.5 s

TEST(Take, SamplesOfAWindow) {
  EXPECT_DOUBLE_EQ(take("take = 'last'", line), 5);
  EXPECT_DOUBLE_EQ(take("take = 'first'\nstart = '0.5 s'", line), 4);
  EXPECT_DOUBLE_EQ(take("take = 'max'\nend = '0.5 s'", line), 4);
  EXPECT_DOUBLE_EQ(take("take = 'min'\nstart = 0.25", line), 3.5);
  EXPECT_DOUBLE_EQ(take("take = 'growth'\nstart = 0.25\nend = 0.75", line), 1);
  EXPECT_NEAR(take("take = 'mean'", line), 4, 1e-12);
  EXPECT_NEAR(take("take = 'mean'", hat), 0.5, 1e-12);
  EXPECT_NEAR(take("take = 'rms'", [](double) { return -2.0; }), 2, 1e-12);
  EXPECT_NEAR(take("take = 'growth_rate'\nstart = 0.3", line), 2, 1e-12);
  EXPECT_TRUE(std::isnan(take("take = 'last'\nstart = '2 s'", line)));
}

TEST(Take, MeanWeighsByTimeNotBySamples) {
  // 0 for 1 s, sampled once at each end, then 1 for 1 s sampled finely, with a jump in between.
  std::vector<double> times{0, 1}, values{0, 0};
  for (int k = 0; k <= 1000; ++k) {
    times.push_back(1 + 1e-9 + 1e-3 * k);
    values.push_back(1);
  }
  EXPECT_NEAR(take_from(quantity("take = 'mean'"), times, values), 0.5, 1e-6);
}

TEST(Take, RiseSeesOnlyWhatGoesUp) {
  EXPECT_DOUBLE_EQ(take("take = 'rise'", hat), 1);
  EXPECT_DOUBLE_EQ(take("take = 'rise'\nstart = '0.5 s'", hat), 0);
  EXPECT_DOUBLE_EQ(take("take = 'rise'", [](double t) { return -t; }), 0);
}

TEST(Take, RippleLeavesStraightLinesAndKeepsFastSwings) {
  EXPECT_NEAR(take("take = 'ripple'\nperiod = '0.1 s'", line), 0, 1e-12);
  // A sine of period 0.05 s and amplitude 2: its mean over 0.1 s vanishes but for one sample in eleven, RMS 2/sqrt(2).
  const double swing =
      take("take = 'ripple'\nperiod = '0.1 s'", [](double t) { return 2 * std::sin(40 * std::numbers::pi * t) + t; });
  EXPECT_NEAR(swing, std::sqrt(2.0), 0.1 * std::sqrt(2.0));
  // One of period 1 s is nearly gone: a mean of eleven samples leaves 1 - sin(11 x)/(11 sin x) of it, x = pi 0.01.
  const double x = 0.01 * std::numbers::pi, left = 1 - std::sin(11 * x) / (11 * std::sin(x));
  const double slow =
      take("take = 'ripple'\nperiod = '0.1 s'", [](double t) { return 2 * std::sin(2 * std::numbers::pi * t); });
  EXPECT_NEAR(slow, std::sqrt(2.0) * left, 0.002);
}

TEST(Take, TimeToAThreshold) {
  EXPECT_NEAR(take("take = 'time_to'\nabove = 4", line), 0.51, 1e-9);
  EXPECT_EQ(take("take = 'time_to'\nabove = 6", line), infinity);
  EXPECT_NEAR(take("take = 'time_to'\nbelow = 0.5", hat), 0, 1e-9);
  EXPECT_NEAR(take("take = 'time_to'\nbelow = 0.5\nstays = true", hat), 0.76, 1e-9);
}

TEST(Take, DeviationFromAReference) {
  const std::vector<double> x{0, 1, 2}, y{0, 2, 4};
  const ReferenceSeries same{{0.25, 1.5}, {0.5, 3}, 0, false};
  EXPECT_NEAR(deviation(same, x, y), 0, 1e-15);
  ReferenceSeries apart{{0.5, 1.5}, {2, 4}, 0, false};  // ours are 1 and 3: one less
  EXPECT_NEAR(deviation(apart, x, y), 1, 1e-15);
  apart.relative = true;
  EXPECT_NEAR(deviation(apart, x, y), 0.5, 1e-15);
  apart.shift = 0.5;  // later by half: 2 and 4
  EXPECT_NEAR(deviation(apart, x, y), 0, 1e-12);
  const ReferenceSeries beyond{{1, 3, 4, 5}, {2, 6, 8, 10}, 0, false};
  EXPECT_TRUE(std::isnan(deviation(beyond, x, y)));
}

TEST(Verdict, FirstRuleThatHolds) {
  const Document file = document(
      "name = \"v\"\nrules = [{ when = 'a > 1', says = 'high' }, { when = 'b > 1', says = 'b' }, { says = 'low' }]");
  const Verdict verdict = read_verdict(file.root(), {"a", "b"});
  const auto says = [&](double a, double b) { return judge(verdict, std::vector<double>{a, b}); };
  EXPECT_EQ(says(2, 2), "high");
  EXPECT_EQ(says(0, 2), "b");
  EXPECT_EQ(says(0, 0), "low");
  EXPECT_EQ(says(infinity, 0), "high");
  EXPECT_EQ(says(2, std::nan("")), "high");  // the second rule is not needed
  EXPECT_EQ(says(0, std::nan("")), not_measured);
}

}  // namespace
}  // namespace undine::study
