#include "undine/analysis/norms.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace undine {
namespace {

/// Volumes from 0.1 to 10 and two fields from -100 to 100, of one length from 1.
struct Sample {
  std::vector<double> volumes, f, g;
};
Sample any_sample() {
  Sample s;
  const int n = *rc::gen::inRange(1, 40);
  for (int i = 0; i < n; ++i) {
    s.volumes.push_back(*rc::gen::inRange(1, 101) / 10.0);
    s.f.push_back(*rc::gen::inRange(-10000, 10001) / 100.0);
    s.g.push_back(*rc::gen::inRange(-10000, 10001) / 100.0);
  }
  return s;
}

TEST(Norms, OfKnownFields) {
  const Norms n = error_norms(std::vector{1.0, 3.0}, std::vector{2.0, 5.0}, std::vector{1.0, 7.0});
  EXPECT_DOUBLE_EQ(n.l1, (1 * 1 + 3 * 2) / 4.0);
  EXPECT_DOUBLE_EQ(n.l2, std::sqrt((1 * 1 + 3 * 4) / 4.0));
  EXPECT_DOUBLE_EQ(n.linf, 2);
  EXPECT_DOUBLE_EQ(n.relative, std::sqrt((1.0 + 12) / (1 + 3 * 49)));
}

RC_GTEST_PROP(Norms, AreOrdered, ()) {
  const Sample s = any_sample();
  const Norms n = error_norms(s.volumes, s.f, s.g);
  RC_ASSERT(n.l1 <= n.l2 * (1 + 1e-12) && n.l2 <= n.linf * (1 + 1e-12));
}

RC_GTEST_PROP(Norms, ScaleWithTheErrorAndNotWithTheVolume, ()) {
  Sample s = any_sample();
  const Norms before = error_norms(s.volumes, s.f, s.g);
  for (std::size_t i = 0; i < s.f.size(); ++i) {
    s.volumes[i] *= 7;
    s.f[i] *= -3;
    s.g[i] *= -3;
  }
  const Norms after = error_norms(s.volumes, s.f, s.g);
  RC_ASSERT(std::abs(after.l1 - 3 * before.l1) <= 1e-12 * after.l1);
  RC_ASSERT(std::abs(after.l2 - 3 * before.l2) <= 1e-12 * after.l2);
  RC_ASSERT(std::abs(after.linf - 3 * before.linf) <= 1e-12 * after.linf);
  if (std::isfinite(before.relative)) RC_ASSERT(std::abs(after.relative - before.relative) <= 1e-12 * after.relative);
}

RC_GTEST_PROP(Norms, AreZeroForEqualFieldsOnly, ()) {
  Sample s = any_sample();
  const Norms none = error_norms(s.volumes, s.g, s.g);
  RC_ASSERT(none.l1 == 0 && none.l2 == 0 && none.linf == 0 && none.relative == 0);
  s.f = s.g;
  s.f[s.f.size() / 2] += 0.5;
  const Norms one = error_norms(s.volumes, s.f, s.g);
  RC_ASSERT(one.l1 > 0 && one.l2 > 0 && one.linf > 0);
}

// Splitting particles into parts, or one particle into two of half the volume, changes nothing.
RC_GTEST_PROP(Norms, AddUp, ()) {
  const Sample s = any_sample();
  NormSums first, second, halves;
  for (std::size_t i = 0; i < s.f.size(); ++i) {
    (i % 3 == 0 ? first : second).add(s.volumes[i], s.f[i] - s.g[i], s.g[i]);
    for (int k = 0; k < 2; ++k) halves.add(0.5 * s.volumes[i], s.f[i] - s.g[i], s.g[i]);
  }
  first += second;
  const Norms whole = error_norms(s.volumes, s.f, s.g);
  for (const Norms& other : {first.norms(), halves.norms()}) {
    RC_ASSERT(std::abs(other.l1 - whole.l1) <= 1e-12 * whole.l1);
    RC_ASSERT(std::abs(other.l2 - whole.l2) <= 1e-12 * whole.l2);
    RC_ASSERT(other.linf == whole.linf);
  }
}

TEST(Norms, DoNotHideWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& f : {std::vector{nan, 1.0}, {1.0, nan}, {5.0, nan, 2.0}}) {
    const std::vector<double> ones(f.size(), 1.0);
    const Norms n = error_norms(ones, f, ones);
    EXPECT_TRUE(std::isnan(n.l1) && std::isnan(n.l2) && std::isnan(n.linf));
  }
  EXPECT_TRUE(std::isnan(NormSums().norms().l2));
  EXPECT_TRUE(std::isinf(error_norms(std::vector{1.0}, std::vector{1.0}, std::vector{0.0}).relative));
}

}  // namespace
}  // namespace undine
