#include "undine/kernels/kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "undine/core/pack.hpp"
#include "unit/kernels/jet.hpp"

// Every test runs over every kernel of the list in 1, 2 and 3 dimensions; a new kernel is tested by being in the list.

namespace undine {
namespace {

using kernel_parts::pi;
using test::Jet;

/// Joints of piecewise kernels are looked for at whole multiples of 1/60: halves, thirds, fourths, fifths and sixths.
constexpr int panels = 60;

/// Calls f.operator()<K, N>() for every kernel in every dimension, with their names in the failure text.
template <class F>
void for_all(F f) {
  Kernels::for_each([&f]<class K>(K) {
    auto in_dimension = [&f]<int N>() {
      SCOPED_TRACE(std::string(K::info.name) + " in " + std::to_string(N) + "-D");
      f.template operator()<K, N>();
    };
    in_dimension.template operator()<1>();
    in_dimension.template operator()<2>();
    in_dimension.template operator()<3>();
  });
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
template <int N>
double sphere(double R) {
  return N == 1 ? 2 : N == 2 ? 2 * pi * R : 4 * pi * R * R;
}

/// Integral of W.
template <class K, int N>
double total() {
  return integral([](double R) { return sphere<N>(R) * NormedKernel<K>::template w<N>(R); });
}

/// Second moment about one axis, integral of x^2 W for H = 1.
template <class K, int N>
double second_moment() {
  return integral([](double R) { return sphere<N>(R) * R * R / N * NormedKernel<K>::template w<N>(R); });
}

template <class K, int N>
constexpr double expected_total() {
  if constexpr (K::exactly_normalised)
    return 1;
  else
    return 1 + K::template norm_defect<N>();
}

/// Largest magnitude of g on (0, 1): the scale against which differences are judged.
template <class F>
double scale(F g) {
  double largest = 0;
  for (int k = 0; k < panels; ++k) largest = std::max(largest, std::abs(g((k + 0.5) / panels)));
  return largest;
}

/// Calls f(x, R) for every point of the lattice of spacing dx within the unit ball.
template <int N, class F>
void for_lattice(double dx, Vec<N> start, F f) {
  const int reach = static_cast<int>(1 / dx) + 1;
  const int count = 2 * reach + 1;
  int all = 1;
  for (int d = 0; d < N; ++d) all *= count;
  for (int k = 0; k < all; ++k) {
    Vec<N> x = start;
    int rest = k;
    for (int d = 0; d < N; ++d, rest /= count) x[d] += dx * (rest % count - reach);
    if (const double R = norm(x); R < 1) f(x, R);
  }
}

/// H/dx for h = 1.2 dx. Kernels that are written with H = h (poly6, spiky) would have no neighbours: they get H = 2 h
/// too.
template <class K>
constexpr double supports_per_spacing() {
  return 1.2 * std::max(2.0, K::natural_kappa);
}

TEST(Kernels, HaveDistinctNames) {
  std::set<std::string_view> names;
  Kernels::for_each([&names]<class K>(K) {
    EXPECT_TRUE(names.insert(K::info.name).second) << K::info.name;
    EXPECT_FALSE(K::info.title.empty() || K::info.equation.empty() || K::info.citation.empty()) << K::info.name;
  });
}

TEST(Kernels, IntegrateToOne) {
  for_all([]<class K, int N>() { EXPECT_NEAR((total<K, N>()), (expected_total<K, N>()), 1e-10); });
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
  for_all([]<class K, int N>() {
    Vec<N> half;
    const double dx = N == 3 ? 0.04 : 0.01;
    for (int d = 0; d < N; ++d) half[d] = dx / 2;
    Vec<N> first;
    double second = 0;
    for_lattice<N>(dx, half, [&](const Vec<N>& x, double R) {
      const double weight = std::pow(dx, N) * NormedKernel<K>::template w<N>(R);
      first += weight * x;
      second += weight * x[0] * x[0];
    });
    for (int d = 0; d < N; ++d) EXPECT_NEAR(first[d], 0, 1e-12);
    const double exact = second_moment<K, N>();
    EXPECT_NEAR(second, exact, 2e-3 * std::max(std::abs(exact), 0.1));
    if (K::positive)
      EXPECT_GT(exact, 0.01);
    else
      EXPECT_GT(exact, -0.01);
    RecordProperty(std::string(K::info.name) + "_" + std::to_string(N), std::to_string(exact));
  });
}

TEST(Kernels, ArePositiveAndMonotoneWhereTheySaySo) {
  for_all([]<class K, int N>() {
    bool positive = true;
    bool monotone = true;
    for (int k = 0; k < 1000; ++k) {
      const double R = k / 1000.0;
      positive = positive && NormedKernel<K>::template w<N>(R) > 0;
      monotone = monotone && NormedKernel<K>::template w<N>(R) > NormedKernel<K>::template w<N>(R + 0.001) &&
                 NormedKernel<K>::template slope<N>(R) <= 0;
    }
    EXPECT_EQ(positive, K::positive);
    EXPECT_EQ(monotone, K::monotone);
  });
}

TEST(Kernels, AreExactlyZeroFromTheSupportOn) {
  for_all([]<class K, int N>() {
    for (const double R : {1.0, 1 + 1e-15, 1.0001, 1.5, 3.0, 100.0, 1e6}) {
      const KernelChoice kernel = KernelChoice::of<K>();
      for (const double value : {kernel.w<N>(R), kernel.slope<N>(R), kernel.slope_over_R<N>(R), kernel.curvature<N>(R),
                                 kernel.laplacian<N>(R)})
        EXPECT_EQ(value, 0) << "R = " << R;
      const float R32 = static_cast<float>(R);
      for (const float value : {kernel.w<N>(R32), kernel.slope<N>(R32), kernel.slope_over_R<N>(R32),
                                kernel.curvature<N>(R32), kernel.laplacian<N>(R32)})
        EXPECT_EQ(value, 0) << "R = " << R;
    }
  });
}

TEST(Kernels, AreFiniteAtTheCentre) {
  for_all([]<class K, int N>() {
    const KernelChoice kernel = KernelChoice::of<K>();
    for (const float R : {0.0F, 1e-30F, 1e-12F, 1e-6F}) {
      for (const float value : {kernel.w<N>(R), kernel.slope<N>(R), kernel.slope_over_R<N>(R), kernel.curvature<N>(R),
                                kernel.laplacian<N>(R)})
        EXPECT_TRUE(std::isfinite(value)) << "R = " << R;
    }
  });
}

TEST(Kernels, SlopeAndCurvatureAreTheDerivatives) {
  for_all([]<class K, int N>() {
    auto shape = [](double R) { return K::template shape<N>(R); };
    auto slope = [](double R) { return K::template slope<N>(R); };
    auto curvature = [](double R) { return K::template curvature<N>(R); };
    const double delta = 1e-5;
    for (int k = 0; k < panels; ++k) {
      const double R = (k + 0.5) / panels;
      EXPECT_NEAR((shape(R + delta) - shape(R - delta)) / (2 * delta), slope(R), 1e-6 * scale(slope)) << "R = " << R;
      EXPECT_NEAR((slope(R + delta) - slope(R - delta)) / (2 * delta), curvature(R), 1e-6 * scale(curvature))
          << "R = " << R;
      const auto series = K::template shape<N>(Jet<2>::variable(R));
      EXPECT_NEAR(series.derivative(1), slope(R), 1e-13 * scale(slope)) << "R = " << R;
      EXPECT_NEAR(series.derivative(2), curvature(R), 1e-13 * scale(curvature)) << "R = " << R;
      EXPECT_NEAR(K::template slope_over_R<N>(R) * R, slope(R), 1e-14 * scale(slope)) << "R = " << R;
    }
  });
}

// Gradient and Laplacian against differences of fourth order of W(|x|) along the axes, from a point that is on none of
// them.
TEST(Kernels, GradientAndLaplacianAreTheOnesInSpace) {
  for_all([]<class K, int N>() {
    using Normed = NormedKernel<K>;
    const double delta = 1e-3;
    for (int k = 6; k < panels; ++k) {
      const double R = (k + 0.5) / panels;
      Vec<N> x;
      for (int d = 0; d < N; ++d) x[d] = d + 1;
      x = x * (R / norm(x));
      double laplacian = 0;
      for (int d = 0; d < N; ++d) {
        auto w = [&x, d](double shift) {
          Vec<N> y = x;
          y[d] += shift;
          return Normed::template w<N>(norm(y));
        };
        const double near = w(delta) - w(-delta);
        const double far = w(2 * delta) - w(-2 * delta);
        EXPECT_NEAR((8 * near - far) / (12 * delta), Normed::template slope_over_R<N>(R) * x[d],
                    1e-7 * scale(Normed::template slope<N, double>))
            << "R = " << R;
        laplacian += (16 * (w(delta) + w(-delta)) - w(2 * delta) - w(-2 * delta) - 30 * w(0)) / (12 * delta * delta);
      }
      EXPECT_NEAR(laplacian, Normed::template laplacian<N>(R), 1e-6 * scale(Normed::template curvature<N, double>))
          << "R = " << R;
    }
  });
}

TEST(Kernels, LaplacianAtTheCentreIsFiniteOrOneOverR) {
  for_all([]<class K, int N>() {
    using Normed = NormedKernel<K>;
    const double slope = Normed::template slope<N>(0.0);
    if (slope == 0) {
      const double curvature = Normed::template curvature<N>(0.0);
      EXPECT_NEAR(Normed::template slope_over_R<N>(0.0), curvature, 1e-12 * std::abs(curvature));
      EXPECT_NEAR(Normed::template laplacian<N>(0.0), N * curvature, 1e-12 * std::abs(curvature));
    } else {
      const double R = 1e-5;
      EXPECT_NEAR(Normed::template laplacian<N>(R) * R, (N - 1) * slope, 1e-4 * std::abs(slope));
    }
  });
}

// The true Laplacian: its integral over space is zero. This has the kink of spiky and quadratic at R = 0 in it for N
// > 1.
TEST(Kernels, LaplacianIntegratesToTheFluxThroughTheEdge) {
  for_all([]<class K, int N>() {
    using Normed = NormedKernel<K>;
    const double sum = integral([](double R) { return sphere<N>(R) * Normed::template laplacian<N>(R); });
    const double edge = 1 - 1e-15;
    const double flux = sphere<N>(edge) * Normed::template slope<N>(edge);
    const double kink = N == 1 ? 2 * Normed::template slope<N>(0.0) : 0;
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
template <class K, int N>
int continuous_derivatives() {
  constexpr int most = 8;
  std::array<double, most + 1> largest{};
  std::array<double, most + 1> jump{};
  const double step = 1e-11;
  for (int k = 0; k <= panels; ++k) {
    const double R = static_cast<double>(k) / panels;
    const auto after = K::template shape<N>(Jet<most>::variable(R + step));
    const auto before = K::template shape<N>(Jet<most>::variable(k == 0 ? step : R - step));
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
  for_all([]<class K, int N>() { EXPECT_EQ((continuous_derivatives<K, N>()), K::smoothness); });
}

/// The wave cos(k x_1) smoothed by a kernel of support radius H, at x = 0: its mean over spheres, weighted by W.
template <class K, int N>
double smoothed_wave(double kH) {
  const double sum = integral([kH](double R) {
    const double mean = N == 1   ? std::cos(kH * R)
                        : N == 2 ? std::cyl_bessel_j(0.0, kH * R)
                                 : std::sin(kH * R) / (kH * R);
    return sphere<N>(R) * NormedKernel<K>::template w<N>(R) * mean;
  });
  return sum / expected_total<K, N>();
}

TEST(Kernels, TendToTheDeltaFunctionWithTheSquareOfH) {
  for_all([]<class K, int N>() {
    const double coarse = std::abs(smoothed_wave<K, N>(0.4) - 1);
    const double fine = std::abs(smoothed_wave<K, N>(0.2) - 1);
    EXPECT_LT(coarse, 0.02);
    const double order = std::log2(coarse / fine);
    if (std::abs(second_moment<K, N>()) > 0.01)
      EXPECT_NEAR(order, 2, 0.02);
    else
      EXPECT_GT(order, 1.98) << "second moment " << second_moment<K, N>();
    // The leading error is k^2/2 times the second moment.
    const double leading = 0.5e-4 * second_moment<K, N>() / expected_total<K, N>();
    EXPECT_NEAR((smoothed_wave<K, N>(0.01)), 1 - leading, 1e-9);
  });
}

TEST(Kernels, SumToOneOnALattice) {
  for_all([]<class K, int N>() {
    const double dx = 1 / supports_per_spacing<K>();
    double sum = 0;
    for_lattice<N>(dx, {},
                   [&sum, dx](const Vec<N>&, double R) { sum += std::pow(dx, N) * NormedKernel<K>::template w<N>(R); });
    // At most 3 % off, but kernels with a kink at the centre weigh the particle itself too much: 9 % (quadratic), 17 %
    // (spiky).
    EXPECT_NEAR(sum, 1, K::smoothness == 0 ? 0.18 : 0.035);
  });
}

/// Error at x = 0 of the kernel estimate, divided by the sum of the weights, of a field of value 1 there; h = 1.2 dx.
template <class K, int N>
double interpolation_error(double dx, auto field) {
  const double ratio = supports_per_spacing<K>();
  double sum = 0;
  double weights = 0;
  for_lattice<N>(1 / ratio, {}, [&](const Vec<N>& x, double R) {
    const double w = NormedKernel<K>::template w<N>(R);
    sum += w * field(x * (ratio * dx));
    weights += w;
  });
  return std::abs(sum / weights - 1);
}

TEST(Kernels, InterpolateToSecondOrderInH) {
  for_all([]<class K, int N>() {
    auto quadratic = [](const Vec<N>& x) {
      double f = 1;
      for (int d = 0; d < N; ++d) f += (d + 0.5) * x[d] + (2 - 0.5 * d) * x[d] * x[d] + (d > 0 ? x[d] * x[d - 1] : 0);
      return f;
    };
    auto smooth = [](const Vec<N>& x) {
      double exponent = 0;
      for (int d = 0; d < N; ++d) exponent += (1 - 0.3 * d) * x[d];
      return std::exp(exponent);
    };
    auto order = [](auto field) {
      return std::log2(interpolation_error<K, N>(0.1, field) / interpolation_error<K, N>(0.05, field));
    };
    EXPECT_NEAR(order(quadratic), 2, 0.1);
    // Without a second moment to speak of, the fourth-order error of a field that is not quadratic shows first.
    if (std::abs(second_moment<K, N>()) > 0.01) {
      EXPECT_NEAR(order(smooth), 2, 0.1);
    }
    EXPECT_LT((interpolation_error<K, N>(0.05, quadratic)), 0.05);
  });
}

TEST(Kernels, AreTheSameInFloatAndInPacks) {
  for_all([]<class K, int N>() {
    using Normed = NormedKernel<K>;
    auto compare = [](auto f) {
      auto in_double = [&f](double R) { return f(R); };
      for (int k = 0; k <= 12 * panels; ++k) {
        const double R = 0.01 + k / (10.0 * panels);
        const float R32 = static_cast<float>(R);
        // At the float's own R, because a jump or a kink may lie between R and its rounding.
        const double exact = in_double(R32);
        EXPECT_NEAR(f(R32), exact, 1e-5 * std::max(scale(in_double), std::abs(exact))) << "R = " << R;
        EXPECT_NEAR((f(Pack<float>(R32))[0]), exact, 1e-5 * std::max(scale(in_double), std::abs(exact))) << "R = " << R;
        EXPECT_NEAR((f(Pack<double>(R))[0]), f(R), 1e-13 * std::max(scale(in_double), std::abs(f(R)))) << "R = " << R;
      }
    };
    compare([]<class V>(const V& R) { return Normed::template w<N>(R); });
    compare([]<class V>(const V& R) { return Normed::template slope<N>(R); });
    compare([]<class V>(const V& R) { return Normed::template slope_over_R<N>(R); });
    compare([]<class V>(const V& R) { return Normed::template curvature<N>(R); });
    compare([]<class V>(const V& R) { return Normed::template laplacian<N>(R); });
  });
}

TEST(KernelChoice, IsTheKernelOfItsIndex) {
  for_all([]<class K, int N>() {
    const KernelChoice kernel(Kernels::index_of(K::info.name));
    EXPECT_EQ(kernel, KernelChoice::of<K>());
    EXPECT_EQ(kernel.info().name, K::info.name);
    EXPECT_EQ(kernel.natural_kappa(), K::natural_kappa);
    EXPECT_EQ(kernel.smoothness(), K::smoothness);
    const double R = 0.37;
    EXPECT_DOUBLE_EQ(kernel.w<N>(R), K::template alpha<N>() * K::template shape<N>(R));
    EXPECT_DOUBLE_EQ(kernel.slope<N>(R), K::template alpha<N>() * K::template slope<N>(R));
    EXPECT_DOUBLE_EQ(kernel.slope_over_R<N>(R), K::template alpha<N>() * K::template slope_over_R<N>(R));
    EXPECT_DOUBLE_EQ(kernel.visit([R](auto k) { return k.template laplacian<N>(R); }), kernel.laplacian<N>(R));
  });
  EXPECT_EQ(KernelChoice().info().name, "wendland_c2");
}

}  // namespace
}  // namespace undine
