#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "unit/kernels/kernel_case.hpp"

// Every test runs over every kernel of the list in 1, 2 and 3 dimensions; a new kernel is tested by being in the list.

namespace undine {
namespace {

using kernel_parts::pi;
using test::chosen_values;
using test::Jet;
using test::KernelCase;

/// Joints of piecewise kernels are looked for at whole multiples of 1/60: halves, thirds, fourths, fifths and sixths.
constexpr int panels = 60;

/// Calls f(k) for every kernel in every dimension, with their names in the failure text.
template <class F>
void for_all(F f) {
  for (const KernelCase& k : test::kernel_cases()) {
    SCOPED_TRACE(std::string(k.info.name) + " in " + std::to_string(k.N) + "-D");
    f(k);
  }
}

/// Integral of g over [0, 1]: 8 Gauss points in each of 60 panels, exact for piecewise polynomials of degree 15.
template <class F>
double integral(F g) {
  constexpr std::array<double, 4> x{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
  const double half = 0.5 / panels;
  double sum = 0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = (2 * panel + 1) * half;
    for (int k = 0; k < 4; ++k) sum += weight[k] * half * (g(middle - half * x[k]) + g(middle + half * x[k]));
  }
  return sum;
}

/// Surface of the unit sphere in N dimensions, times R^(N-1).
double sphere(int N, double R) { return N == 1 ? 2 : N == 2 ? 2 * pi * R : 4 * pi * R * R; }

/// Second moment about one axis, integral of x^2 W for H = 1.
double second_moment(const KernelCase& k) {
  return integral([&](double R) { return sphere(k.N, R) * R * R / k.N * k.normed.w(R); });
}

/// Largest magnitude of g on (0, 1): the scale against which differences are judged.
template <class F>
double scale(F g) {
  double largest = 0;
  for (int k = 0; k < panels; ++k) largest = std::max(largest, std::abs(g((k + 0.5) / panels)));
  return largest;
}

/// Calls f(x, R) for every point of the lattice of spacing dx within the unit ball of N dimensions; the coordinates
/// beyond are zero.
template <class F>
void for_lattice(int N, double dx, Vec<3> start, F f) {
  const int reach = static_cast<int>(1 / dx) + 1;
  const int count = 2 * reach + 1;
  int all = 1;
  for (int d = 0; d < N; ++d) all *= count;
  for (int k = 0; k < all; ++k) {
    Vec<3> x = start;
    int rest = k;
    for (int d = 0; d < N; ++d, rest /= count) x[d] += dx * (rest % count - reach);
    if (const double R = norm(x); R < 1) f(x, R);
  }
}

/// H/dx for h = 1.2 dx. Kernels that are written with H = h (poly6, spiky) would have no neighbours: they get H = 2 h
/// too.
double supports_per_spacing(const KernelCase& k) { return 1.2 * std::max(2.0, k.natural_kappa); }

TEST(Kernels, HaveDistinctNames) {
  std::set<std::string_view> names;
  Kernels::for_each([&names]<class K>(K) {
    EXPECT_TRUE(names.insert(K::info.name).second) << K::info.name;
    EXPECT_FALSE(K::info.title.empty() || K::info.equation.empty() || K::info.citation.empty()) << K::info.name;
  });
}

TEST(Kernels, IntegrateToOne) {
  for_all([](const KernelCase& k) {
    EXPECT_NEAR(integral([&](double R) { return sphere(k.N, R) * k.normed.w(R); }), k.total, 1e-10);
  });
}

TEST(Kernels, SayHowFarTruncationPutsThemOff) {
  EXPECT_NEAR(Gaussian::norm_defect<1>(), -std::erfc(3), 1e-16);
  EXPECT_NEAR(Gaussian::norm_defect<2>(), -1.234098e-4, 1e-10);
  EXPECT_NEAR(Gaussian::norm_defect<3>(), -4.398497e-4, 1e-10);
  EXPECT_NEAR(SuperGaussian::norm_defect<1>(), 1.867891e-4, 1e-10);
  EXPECT_NEAR(SuperGaussian::norm_defect<2>(), 9.872784e-4, 1e-10);
  EXPECT_NEAR(SuperGaussian::norm_defect<3>(), 3.319983e-3, 1e-9);
}

// The radial quadrature against a sum over a Cartesian lattice (midpoint rule), which shares nothing with it.
TEST(Kernels, HaveNoFirstAndThisSecondMoment) {
  for_all([](const KernelCase& k) {
    Vec<3> half;
    const double dx = k.N == 3 ? 0.04 : 0.01;
    for (int d = 0; d < k.N; ++d) half[d] = dx / 2;
    Vec<3> first;
    double second = 0;
    for_lattice(k.N, dx, half, [&](const Vec<3>& x, double R) {
      const double weight = std::pow(dx, k.N) * k.normed.w(R);
      first += weight * x;
      second += weight * x[0] * x[0];
    });
    for (int d = 0; d < k.N; ++d) EXPECT_NEAR(first[d], 0, 1e-12);
    const double exact = second_moment(k);
    EXPECT_NEAR(second, exact, 2e-3 * std::max(std::abs(exact), 0.1));
    if (k.positive)
      EXPECT_GT(exact, 0.01);
    else
      EXPECT_GT(exact, -0.01);
    ::testing::Test::RecordProperty(std::string(k.info.name) + "_" + std::to_string(k.N), std::to_string(exact));
  });
}

TEST(Kernels, ArePositiveAndMonotoneWhereTheySaySo) {
  for_all([](const KernelCase& k) {
    bool positive = true;
    bool monotone = true;
    for (int n = 0; n < 1000; ++n) {
      const double R = n / 1000.0;
      positive = positive && k.normed.w(R) > 0;
      monotone = monotone && k.normed.w(R) > k.normed.w(R + 0.001) && k.normed.slope(R) <= 0;
    }
    EXPECT_EQ(positive, k.positive);
    EXPECT_EQ(monotone, k.monotone);
  });
}

TEST(Kernels, AreExactlyZeroFromTheSupportOn) {
  for_all([](const KernelCase& k) {
    for (const double R : {1.0, 1 + 1e-15, 1.0001, 1.5, 3.0, 100.0, 1e6}) {
      for (const double value : chosen_values(k, R)) EXPECT_EQ(value, 0) << "R = " << R;
      for (const float value : chosen_values(k, static_cast<float>(R))) EXPECT_EQ(value, 0) << "R = " << R;
    }
  });
}

TEST(Kernels, AreFiniteAtTheCentre) {
  for_all([](const KernelCase& k) {
    for (const float R : {0.0F, 1e-30F, 1e-12F, 1e-6F})
      for (const float value : chosen_values(k, R)) EXPECT_TRUE(std::isfinite(value)) << "R = " << R;
  });
}

TEST(Kernels, SlopeAndCurvatureAreTheDerivatives) {
  for_all([](const KernelCase& k) {
    const double delta = 1e-5;
    for (int n = 0; n < panels; ++n) {
      const double R = (n + 0.5) / panels;
      EXPECT_NEAR((k.shape(R + delta) - k.shape(R - delta)) / (2 * delta), k.slope(R), 1e-6 * scale(k.slope))
          << "R = " << R;
      EXPECT_NEAR((k.slope(R + delta) - k.slope(R - delta)) / (2 * delta), k.curvature(R), 1e-6 * scale(k.curvature))
          << "R = " << R;
      const auto series = k.short_series(Jet<2>::variable(R));
      EXPECT_NEAR(series.derivative(1), k.slope(R), 1e-13 * scale(k.slope)) << "R = " << R;
      EXPECT_NEAR(series.derivative(2), k.curvature(R), 1e-13 * scale(k.curvature)) << "R = " << R;
      EXPECT_NEAR(k.slope_over_R(R) * R, k.slope(R), 1e-14 * scale(k.slope)) << "R = " << R;
    }
  });
}

// Gradient and Laplacian against differences of fourth order of W(|x|) along the axes, from a point that is on none of
// them.
TEST(Kernels, GradientAndLaplacianAreTheOnesInSpace) {
  for_all([](const KernelCase& k) {
    const double delta = 1e-3;
    for (int n = 6; n < panels; ++n) {
      const double R = (n + 0.5) / panels;
      Vec<3> x;
      for (int d = 0; d < k.N; ++d) x[d] = d + 1;
      x = x * (R / norm(x));
      double laplacian = 0;
      for (int d = 0; d < k.N; ++d) {
        auto w = [&x, &k, d](double shift) {
          Vec<3> y = x;
          y[d] += shift;
          return k.normed.w(norm(y));
        };
        const double near = w(delta) - w(-delta);
        const double far = w(2 * delta) - w(-2 * delta);
        EXPECT_NEAR((8 * near - far) / (12 * delta), k.normed.slope_over_R(R) * x[d], 1e-7 * scale(k.normed.slope))
            << "R = " << R;
        laplacian += (16 * (w(delta) + w(-delta)) - w(2 * delta) - w(-2 * delta) - 30 * w(0)) / (12 * delta * delta);
      }
      EXPECT_NEAR(laplacian, k.normed.laplacian(R), 1e-6 * scale(k.normed.curvature)) << "R = " << R;
    }
  });
}

TEST(Kernels, LaplacianAtTheCentreIsFiniteOrOneOverR) {
  for_all([](const KernelCase& k) {
    const double slope = k.normed.slope(0.0);
    if (slope == 0) {
      const double curvature = k.normed.curvature(0.0);
      EXPECT_NEAR(k.normed.slope_over_R(0.0), curvature, 1e-12 * std::abs(curvature));
      EXPECT_NEAR(k.normed.laplacian(0.0), k.N * curvature, 1e-12 * std::abs(curvature));
    } else {
      const double R = 1e-5;
      EXPECT_NEAR(k.normed.laplacian(R) * R, (k.N - 1) * slope, 1e-4 * std::abs(slope));
    }
  });
}

// The true Laplacian: its integral over space is zero. This has the kink of spiky and quadratic at R = 0 in it for N
// > 1.
TEST(Kernels, LaplacianIntegratesToTheFluxThroughTheEdge) {
  for_all([](const KernelCase& k) {
    const double sum = integral([&](double R) { return sphere(k.N, R) * k.normed.laplacian(R); });
    const double edge = 1 - 1e-15;
    const double flux = sphere(k.N, edge) * k.normed.slope(edge);
    const double kink = k.N == 1 ? 2 * k.normed.slope(0.0) : 0;
    EXPECT_NEAR(sum, flux - kink, 1e-9);
  });
}

// Saalfeld (2012), eq. 66, with the sign put right: +90/(pi H^6) (H-r) (2 - H/r).
TEST(Kernels, SpikyHasThisLaplacian) {
  for (const double R : {0.01, 0.2, 0.5, 0.7, 0.99}) {
    const double exact = 90 / pi * (1 - R) * (2 - 1 / R);
    EXPECT_NEAR(NormedKernel<Spiky>::laplacian<3>(R), exact, 1e-12 * (1 + std::abs(exact)));
  }
}

/// How many derivatives of W are continuous along a line through the centre: -1 if W itself is not.
int continuous_derivatives(const KernelCase& kernel) {
  constexpr int most = 8;
  std::array<double, most + 1> largest{};
  std::array<double, most + 1> jump{};
  const double step = 1e-11;
  for (int k = 0; k <= panels; ++k) {
    const double R = static_cast<double>(k) / panels;
    const auto after = kernel.long_series(Jet<most>::variable(R + step));
    const auto before = kernel.long_series(Jet<most>::variable(k == 0 ? step : R - step));
    for (int n = 0; n <= most; ++n) {
      // W(-x) = W(x): at the centre even derivatives agree and odd ones change sign.
      const double left = k == 0 && n % 2 == 1 ? -before.derivative(n) : before.derivative(n);
      largest[n] = std::max({largest[n], std::abs(left), std::abs(after.derivative(n))});
      jump[n] = std::max(jump[n], std::abs(after.derivative(n) - left));
    }
  }
  for (int n = 0; n <= most; ++n)
    if (jump[n] > 1e-7 * largest[n]) return n - 1;
  return most;
}

TEST(Kernels, AreAsSmoothAsTheySayAndNoSmoother) {
  for_all([](const KernelCase& k) { EXPECT_EQ(continuous_derivatives(k), k.smoothness); });
}

/// The wave cos(k x_1) smoothed by a kernel of support radius H, at x = 0: its mean over spheres, weighted by W.
double smoothed_wave(const KernelCase& k, double kH) {
  const double sum = integral([&](double R) {
    const double mean = k.N == 1   ? std::cos(kH * R)
                        : k.N == 2 ? std::cyl_bessel_j(0.0, kH * R)
                                   : std::sin(kH * R) / (kH * R);
    return sphere(k.N, R) * k.normed.w(R) * mean;
  });
  return sum / k.total;
}

TEST(Kernels, TendToTheDeltaFunctionWithTheSquareOfH) {
  for_all([](const KernelCase& k) {
    const double coarse = std::abs(smoothed_wave(k, 0.4) - 1);
    const double fine = std::abs(smoothed_wave(k, 0.2) - 1);
    EXPECT_LT(coarse, 0.02);
    const double order = std::log2(coarse / fine);
    if (std::abs(second_moment(k)) > 0.01)
      EXPECT_NEAR(order, 2, 0.02);
    else
      EXPECT_GT(order, 1.98) << "second moment " << second_moment(k);
    // The leading error is k^2/2 times the second moment.
    const double leading = 0.5e-4 * second_moment(k) / k.total;
    EXPECT_NEAR(smoothed_wave(k, 0.01), 1 - leading, 1e-9);
  });
}

TEST(Kernels, SumToOneOnALattice) {
  for_all([](const KernelCase& k) {
    const double dx = 1 / supports_per_spacing(k);
    double sum = 0;
    for_lattice(k.N, dx, {}, [&](const Vec<3>&, double R) { sum += std::pow(dx, k.N) * k.normed.w(R); });
    // At most 3 % off, but kernels with a kink at the centre weigh the particle itself too much: 9 % (quadratic), 17 %
    // (spiky).
    EXPECT_NEAR(sum, 1, k.smoothness == 0 ? 0.18 : 0.035);
  });
}

/// Error at x = 0 of the kernel estimate, divided by the sum of the weights, of a field of value 1 there; h = 1.2 dx.
double interpolation_error(const KernelCase& k, double dx, auto field) {
  const double ratio = supports_per_spacing(k);
  double sum = 0;
  double weights = 0;
  for_lattice(k.N, 1 / ratio, {}, [&](const Vec<3>& x, double R) {
    const double w = k.normed.w(R);
    sum += w * field(x * (ratio * dx));
    weights += w;
  });
  return std::abs(sum / weights - 1);
}

TEST(Kernels, InterpolateToSecondOrderInH) {
  for_all([](const KernelCase& k) {
    auto quadratic = [&k](const Vec<3>& x) {
      double f = 1;
      for (int d = 0; d < k.N; ++d) f += (d + 0.5) * x[d] + (2 - 0.5 * d) * x[d] * x[d] + (d > 0 ? x[d] * x[d - 1] : 0);
      return f;
    };
    auto smooth = [&k](const Vec<3>& x) {
      double exponent = 0;
      for (int d = 0; d < k.N; ++d) exponent += (1 - 0.3 * d) * x[d];
      return std::exp(exponent);
    };
    auto order = [&k](auto field) {
      return std::log2(interpolation_error(k, 0.1, field) / interpolation_error(k, 0.05, field));
    };
    EXPECT_NEAR(order(quadratic), 2, 0.1);
    // Without a second moment to speak of, the fourth-order error of a field that is not quadratic shows first.
    if (std::abs(second_moment(k)) > 0.01) {
      EXPECT_NEAR(order(smooth), 2, 0.1);
    }
    EXPECT_LT(interpolation_error(k, 0.05, quadratic), 0.05);
  });
}

TEST(Kernels, AreTheSameInFloatAndInPacks) {
  for_all([](const KernelCase& kernel) {
    for (std::size_t f = 0; f < kernel.normed.all().size(); ++f) {
      const auto in_double = kernel.normed.all()[f];
      const auto in_float = kernel.in_float.all()[f];
      const auto in_float_pack = kernel.in_float_pack.all()[f];
      const auto in_double_pack = kernel.in_double_pack.all()[f];
      for (int k = 0; k <= 12 * panels; ++k) {
        const double R = 0.01 + k / (10.0 * panels);
        const float R32 = static_cast<float>(R);
        // At the float's own R, because a jump or a kink may lie between R and its rounding.
        const double exact = in_double(R32), value = in_double(R);
        const double tolerance = 1e-5 * std::max(scale(in_double), std::abs(exact));
        EXPECT_NEAR(in_float(R32), exact, tolerance) << "R = " << R;
        EXPECT_NEAR(in_float_pack(Pack<float>(R32))[0], exact, tolerance) << "R = " << R;
        EXPECT_NEAR(in_double_pack(Pack<double>(R))[0], value, 1e-13 * std::max(scale(in_double), std::abs(value)))
            << "R = " << R;
      }
    }
  });
}

TEST(KernelChoice, IsTheKernelOfItsIndex) {
  for_all([](const KernelCase& k) {
    const KernelChoice kernel(Kernels::index_of(k.info.name));
    EXPECT_EQ(kernel, k.choice);
    EXPECT_EQ(kernel.info().name, k.info.name);
    EXPECT_EQ(kernel.natural_kappa(), k.natural_kappa);
    EXPECT_EQ(kernel.smoothness(), k.smoothness);
    const double R = 0.37;
    const auto [w, slope, slope_over_R, curvature, laplacian] = chosen_values(k, R);
    EXPECT_DOUBLE_EQ(w, k.alpha * k.shape(R));
    EXPECT_DOUBLE_EQ(slope, k.alpha * k.slope(R));
    EXPECT_DOUBLE_EQ(slope_over_R, k.alpha * k.slope_over_R(R));
    EXPECT_DOUBLE_EQ(curvature, k.alpha * k.curvature(R));
    EXPECT_DOUBLE_EQ(laplacian, k.normed.laplacian(R));
  });
  EXPECT_EQ(KernelChoice().info().name, "wendland_c2");
}

}  // namespace
}  // namespace undine
