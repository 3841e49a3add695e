#include "undine/approximation/approximation.hpp"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "undine/core/error.hpp"
#include "unit/approximation/scattered.hpp"

namespace undine::approximation {
namespace {

using test::for_each_method;
using test::Random;
using test::scattered;
using testing::HasSubstr;

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

/// The correction function as printed, from moments of (x - xi)^k: Niedoba (2012), eq. 2.81-2.86. Moments of xi^k, as
/// eq. 2.84 prints them, do not even reproduce constants.
TEST(Approximation, RkpmOfFirstOrderIsThatOfTheThesis) {
  Random random(1);
  const auto points = scattered<1>(20, random);
  const double H = 0.2;
  const KernelChoice kernel;
  const Approximation<1> by(points, {.method = "rkpm", .order = 1, .support = H});
  for (const double x : {0.0, 0.07, 0.4, 0.51, 1.0}) {
    const auto stencil = by.stencil({{x}});
    double m[3]{}, printed[3]{};
    for (std::size_t j = 0; j < points.x.size(); ++j) {
      const double xi = points.x[j][0];
      for (int k = 0; k < 3; ++k) {
        const double W_V = kernel.w<1>(std::abs(x - xi) / H) / H * points.volume[j];
        m[k] += std::pow(x - xi, k) * W_V;
        printed[k] += std::pow(xi, k) * W_V;
      }
    }
    const auto c = [](const double* moment, int k) {
      return moment[3 - k] / (moment[0] * moment[2] - moment[1] * moment[1]);
    };
    double sum = 0;
    for (std::size_t k = 0; k < stencil.points.size(); ++k) {
      const std::size_t j = stencil.points[k];
      const double xi = points.x[j][0], W_V = kernel.w<1>(std::abs(x - xi) / H) / H * points.volume[j];
      EXPECT_NEAR(stencil.value[k], (c(m, 1) + c(m, 2) * (xi - x)) * W_V, 1e-12);
      sum += (c(printed, 1) + c(printed, 2) * (xi - x)) * W_V;
    }
    if (x > 0.3) {
      EXPECT_GT(std::abs(sum - 1), 0.1);
    }
  }
}

TEST(Approximation, ShepardIsRkpmOfOrderZero) {
  Random random(2);
  const auto points = scattered<3>(6, random);
  const Approximation<3> shepard(points, {.method = "shepard", .support = 0.5});
  const Approximation<3> rkpm(points, {.method = "rkpm", .order = 0, .support = 0.5});
  for (const auto& x : {Vec<3>{{0, 0.3, 1}}, Vec<3>{{0.5, 0.5, 0.4}}}) {
    const auto a = shepard.stencil(x), b = rkpm.stencil(x);
    ASSERT_EQ(a.points, b.points);
    for (std::size_t j = 0; j < a.points.size(); ++j) {
      EXPECT_NEAR(a.value[j], b.value[j], 1e-14);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(a.gradient[j][k], b.gradient[j][k], 1e-12);
        for (int l = 0; l < 3; ++l) EXPECT_NEAR(a.hessian[j][k][l], b.hessian[j][k][l], 1e-10);
      }
    }
  }
}

/// Criterion: the gradient is the derivative of the value and the Hessian that of the gradient, by central differences
/// of random data. Not of the finite point method, whose derivatives leave the weights out by definition, nor across a
/// jump of the methods that have some: the queries keep their neighbours and their nearest point.
template <int N>
void expect_true_derivatives(double H, int n) {
  Random random(3);
  const auto points = scattered<N>(n, random);
  std::vector<double> u;
  for (std::size_t i = 0; i < points.x.size(); ++i) u.push_back(random.between(-1, 1));
  const double step = 1e-5 * H;
  for_each_method([&](const std::string& method, int order) {
    if (method == "finite_point") return;
    SCOPED_TRACE(testing::Message() << method << " order " << order << " in " << N << "-D");
    const Approximation<N> by(points, {.method = method, .order = order, .support = H});
    const auto at = [&](const Vec<N>& x) { return by.evaluate(std::vector{x}, {u}).fields[0][0]; };
    for (int q = 0; q < 4; ++q) {
      Vec<N> x;
      for (int k = 0; k < N; ++k) x[k] = random.between(0, 1);
      const auto here = at(x);
      double gradient_size = 1, hessian_size = 1;
      for (int a = 0; a < N; ++a) {
        gradient_size = std::max(gradient_size, std::abs(here.gradient[a]));
        for (int b = 0; b < N; ++b) hessian_size = std::max(hessian_size, std::abs(here.hessian[a][b]));
      }
      for (int a = 0; a < N; ++a) {
        Vec<N> up = x, down = x;
        up[a] += step;
        down[a] -= step;
        const auto after = at(up), before = at(down);
        EXPECT_NEAR((after.value - before.value) / (2 * step), here.gradient[a], 1e-4 * gradient_size);
        if (by.degrees().hessian == Degrees::not_given) continue;
        for (int b = 0; b < N; ++b)
          EXPECT_NEAR((after.gradient[b] - before.gradient[b]) / (2 * step), here.hessian[b][a], 1e-3 * hessian_size);
      }
    }
  });
}

TEST(Approximation, DerivativesAreThoseOfTheEstimate) {
  expect_true_derivatives<1>(0.16, 20);
  expect_true_derivatives<2>(0.3, 10);
  expect_true_derivatives<3>(0.5, 6);
}

TEST(Approximation, SomeMethodsPassThroughTheData) {
  Random random(4);
  const auto points = scattered<2>(12, random);
  for (const char* method :
       {"point_interpolation", "radial_point_interpolation", "finite_differences", "corrected_gradient"}) {
    SCOPED_TRACE(method);
    const Approximation<2> by(points, {.method = method, .order = 1, .support = 0.25});
    for (std::uint32_t i = 0; i < points.x.size(); i += 7) {
      const auto stencil = by.stencil(points.x[i]);
      ASSERT_EQ(stencil.status, Status::ok);
      for (std::size_t j = 0; j < stencil.points.size(); ++j)
        EXPECT_NEAR(stencil.value[j], stencil.points[j] == i ? 1 : 0, 1e-9);
    }
  }
}

/// Whatever the neighbourhood: either a status, an empty stencil and NaN, or ok and finite numbers.
template <int N>
std::vector<Status> statuses(const Points<N>& points, const Vec<N>& x, double H) {
  std::vector<Status> all;
  const std::vector<double> u(points.x.size(), 2.5);
  for_each_method([&](const std::string& method, int order) {
    SCOPED_TRACE(testing::Message() << method << " order " << order);
    const Approximation<N> by(points, {.method = method, .order = order, .support = H});
    const auto stencil = by.stencil(x);
    const auto estimate = by.evaluate(std::vector{x}, {u});
    EXPECT_EQ(estimate.status[0], stencil.status);
    const auto& value = estimate.fields[0][0];
    if (stencil.status == Status::ok) {
      EXPECT_TRUE(std::isfinite(value.value));
      EXPECT_EQ(std::isfinite(value.gradient[0]), by.degrees().gradient != Degrees::not_given);
      EXPECT_EQ(std::isfinite(value.laplacian()), by.degrees().hessian != Degrees::not_given);
      EXPECT_LE(stencil.condition, 1e10);
    } else {
      EXPECT_TRUE(stencil.points.empty());
      EXPECT_TRUE(std::isnan(value.value) && std::isnan(value.gradient[0]) && std::isnan(value.laplacian()));
    }
    if (order >= 1) all.push_back(stencil.status);
  });
  return all;
}

TEST(Approximation, DegenerateNeighbourhoodsHaveAStatus) {
  using testing::Each;
  Points<2> line, nearly, pair, twins;
  Points<3> plane;
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    const double t = random.between(-1, 1), s = random.between(-1, 1);
    line.x.push_back({{0.1 + 0.6 * t, 0.3 - 0.8 * t}});
    nearly.x.push_back({{0.6 * t + 1e-12 * s, -0.8 * t}});
    plane.x.push_back({{t, s, 0.3 * t - 0.7 * s}});
  }
  for (int i = 0; i < 2; ++i) pair.x.push_back({{0.1 * i, 0}});
  for (int i = 0; i < 40; ++i) twins.x.push_back({{0.1, 0.1}});
  for (auto* points : {&line, &nearly, &pair, &twins}) points->volume.assign(points->x.size(), 0.01);
  plane.volume.assign(plane.x.size(), 0.01);

  EXPECT_THAT(statuses<2>(line, {{0.1, 0.3}}, 0.9), Each(Status::degenerate)) << "collinear, on the line";
  EXPECT_THAT(statuses<2>(line, {{0.3, 0.4}}, 0.9), Each(Status::degenerate)) << "collinear, beside the line";
  EXPECT_THAT(statuses<2>(nearly, {{0.1, 0}}, 0.9), Each(Status::degenerate)) << "collinear but for 1e-12";
  EXPECT_THAT(statuses<3>(plane, {{0, 0, 0.1}}, 0.9), Each(Status::degenerate)) << "coplanar";
  EXPECT_THAT(statuses<2>(twins, {{0.1, 0.15}}, 0.9), Each(Status::degenerate)) << "all in one place";
  EXPECT_THAT(statuses<2>(pair, {{0.05, 0}}, 0.9), Each(Status::too_few));
  EXPECT_THAT(statuses<2>(pair, {{0.05, 5}}, 0.9), Each(Status::no_neighbours));
}

/// Points on a circle determine no quadratic polynomial.
TEST(Approximation, PointsOnAConicAreDegenerateForOrderTwo) {
  Points<2> circle;
  for (int i = 0; i < 20; ++i) circle.x.push_back({{std::cos(i), std::sin(i)}});
  for (const char* method : {"mls", "point_interpolation", "radial_point_interpolation", "finite_point"}) {
    SCOPED_TRACE(method);
    for (const int order : {1, 2}) {
      const Approximation<2> by(circle, {.method = method, .order = order, .support = 1.5});
      EXPECT_EQ(by.stencil({{0.1, 0.05}}).status, order == 1 ? Status::ok : Status::degenerate);
    }
  }
}

/// Kilometres instead of metres, and an origin far away, change nothing but the unit.
TEST(Approximation, DependsNeitherOnTheUnitOfLengthNorOnTheOrigin) {
  Random random(6);
  const auto points = scattered<2>(12, random);
  auto moved = points;
  constexpr double factor = 1024, away = 1 << 20;  // powers of two: no rounding of their own
  for (auto& x : moved.x) x = factor * (x + Vec<2>{{away, -away}} / factor);
  for (auto& V : moved.volume) V *= sq(factor);
  std::vector<double> u;
  for (std::size_t i = 0; i < points.x.size(); ++i) u.push_back(random.between(-1, 1));
  for_each_method([&](const std::string& method, int order) {
    SCOPED_TRACE(testing::Message() << method << " order " << order);
    const Approximation<2> near(points, {.method = method, .order = order, .support = 0.25});
    const Approximation<2> far(moved, {.method = method, .order = order, .support = 0.25 * factor});
    for (const auto& x : {points.x[40], points.x[77]}) {
      const Vec<2> y = factor * (x + Vec<2>{{away, -away}} / factor);
      const auto a = near.evaluate(std::vector{x}, {u}).fields[0][0],
                 b = far.evaluate(std::vector{y}, {u}).fields[0][0];
      EXPECT_NEAR(b.value, a.value, 1e-9);
      EXPECT_NEAR(b.gradient[1] * factor, a.gradient[1], 1e-7);
      if (near.degrees().hessian == Degrees::not_given) continue;
      EXPECT_NEAR(b.laplacian() * sq(factor), a.laplacian(), 1e-5 * (1 + std::abs(a.laplacian())));
    }
  });
}

TEST(Approximation, WorksWithEveryKernelItTakes) {
  Random random(7);
  const auto points = scattered<2>(16, random);
  std::vector<double> u;
  for (const auto& x : points.x) u.push_back(1 + 2 * x[0] - 3 * x[1]);
  for (int k = 0; k < Kernels::size; ++k) {
    SCOPED_TRACE(Kernels::info(k).name);
    const KernelChoice kernel(k);
    const bool kink = kernel.slope<2>(0.0) != 0;
    for_each_method([&](const std::string& method, int order) {
      SCOPED_TRACE(testing::Message() << method << " order " << order);
      const Options options{.method = method, .order = order, .kernel = kernel, .support = 0.22};
      const bool squares = method == "mls" || method == "finite_point";
      const bool positive = kernel.visit([](auto shape) { return decltype(shape)::Shape::positive; });
      if (squares && !positive) {
        EXPECT_THAT(error_of([&] { Approximation<2>(points, options); }), HasSubstr("negative in places"));
        return;
      }
      const Approximation<2> by(points, options);
      if (method == "mls" || method == "sph") {
        EXPECT_EQ(by.degrees().hessian == Degrees::not_given, kink);
      }
      const auto all = by.evaluate(std::vector{Vec<2>{{0.5, 0.45}}, points.x[100]}, {u});
      for (std::size_t q = 0; q < 2; ++q) {
        ASSERT_EQ(all.status[q], Status::ok);
        const Vec<2> x = q == 0 ? Vec<2>{{0.5, 0.45}} : points.x[100];
        if (by.degrees().value >= 1) {
          EXPECT_NEAR(all.fields[0][q].value, 1 + 2 * x[0] - 3 * x[1], 1e-10);
        }
        if (by.degrees().gradient >= 1) {
          EXPECT_NEAR(all.fields[0][q].gradient[1], -3, 1e-9);
        }
      }
    });
  }
}

TEST(Approximation, IsTheSameWithAnySearch) {
  Random random(8);
  const auto points = scattered<3>(6, random);
  const Approximation<3> grid(points, {.method = "mls", .order = 1, .support = 0.4});
  const Approximation<3> all(points, {.method = "mls", .order = 1, .support = 0.4, .search = "all_pairs"});
  const auto a = grid.stencil({{0.3, 0.6, 0.9}}), b = all.stencil({{0.3, 0.6, 0.9}});
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.gradient, b.gradient);
}

TEST(Approximation, SaysWhatIsWrongWithItsInput) {
  const Points<2> points{.x = {{{0, 0}}, {{1, 0}}, {{0, 1}}}};
  const auto complaint = [&](Options options, Points<2> of) {
    return error_of([&] { Approximation<2>(std::move(of), options); });
  };
  EXPECT_THAT(complaint({.method = "msl", .support = 1}, points), HasSubstr("did you mean 'mls'?"));
  EXPECT_THAT(complaint({.method = "mls", .order = 3, .support = 1}, points), HasSubstr("orders 0 to 2"));
  EXPECT_THAT(complaint({.method = "shepard", .order = 1, .support = 1}, points), HasSubstr("its order is 0"));
  EXPECT_THAT(complaint({.method = "rkpm", .support = 1}, points), HasSubstr("needs the volumes"));
  EXPECT_THAT(complaint({.support = 0}, points), HasSubstr("greater than 0"));
  EXPECT_THAT(complaint({.support = std::nan("")}, points), HasSubstr("greater than 0"));
  EXPECT_THAT(complaint({.support = 1, .condition_limit = 0.5}, points), HasSubstr("condition number"));
  EXPECT_THAT(complaint({.support = 1}, {}), HasSubstr("no points"));
  EXPECT_THAT(complaint({.support = 1}, {.x = points.x, .volume = {1, 2}}), HasSubstr("3 points, 2 volumes"));
  EXPECT_THAT(complaint({.support = 1}, {.x = points.x, .volume = {1, 2, 0}}), HasSubstr("volume of point 3"));
  EXPECT_THAT(complaint({.support = 1}, {.x = {{{0, INFINITY}}}}), HasSubstr("point 1 is not finite"));
  EXPECT_THAT(complaint({.support = 1, .search = "tree"}, points), HasSubstr("no neighbour search"));
  const Approximation<2> good(points, {.method = "mls", .order = 1, .support = 2});
  EXPECT_THAT(error_of([&] { good.stencil({{NAN, 0}}); }), HasSubstr("not finite"));
  const std::vector<double> two{1, 2}, bad{1, NAN, 2};
  const std::vector<Vec<2>> queries{{{0.2, 0.2}}};
  EXPECT_THAT(error_of([&] { good.evaluate(queries, {two}); }), HasSubstr("3 points, 2 values"));
  EXPECT_THAT(error_of([&] { good.evaluate(queries, {bad}); }), HasSubstr("value 2 of field 1"));
}

}  // namespace
}  // namespace undine::approximation
