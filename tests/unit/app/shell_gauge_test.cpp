#include <cmath>

#include <gtest/gtest.h>

#include "undine/app/gauges/shell.hpp"
#include "undine/io/case/document.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {
namespace {

using namespace field;

// Criterion: a ridge of density, 1000 + 800 exp(-((r - 0.3)/0.08)^2) around the middle of 40 x 40 particles, is found
// where and as high as it is to a tenth of a shell and 5 %, and its outer flank at half its height to a quarter of one.
TEST(ShellGauge, FindsTheRidgeAroundAPoint) {
  constexpr double spacing = 0.025, width = 0.05;
  GaugeContext<2> context{.spacing = spacing, .interval = 0.1};
  context.domain = {{{0, 0}}, {{1, 1}}, {true, true}};
  Store<2> store;
  store.allocate(Fields<x, v, m, rho, h, rho_0, mu, p, x_list>::set());
  store.append(Group::fluid, 1600, 0);
  for (std::size_t i = 0; i < 1600; ++i) {
    const Vec<2> at{{(static_cast<double>(i % 40) + 0.5) * spacing, (static_cast<double>(i / 40) + 0.5) * spacing}};
    store.get<x>()[i] = at;
    const double r = norm(at - Vec<2>{{0.5, 0.5}});
    store.get<rho>()[i] = 1000 + 800 * std::exp(-sq((r - 0.3) / 0.08));
    store.get<rho_0>()[i] = 1000;
    store.get<m>()[i] = store.get<rho>()[i] * sq(spacing);
    store.get<h>()[i] = 2.6 * spacing;
  }
  WeaklyCompressibleOptions<2> options;
  options.support = {.uniform = 2.6 * spacing, .kappa = 2};
  options.wall_density = walls::WallDensity::none;
  options.materials = {{.eos = materials::Linear{.rho_0 = 1000, .c_0 = 30}}};
  const WeaklyCompressible<2> flow(std::move(store), context.domain, options);

  const Document document = Document::parse("[g]\ncentre = [0.5, 0.5]\nwidth = 0.05\n", "case.toml");
  const gauges::Shell<2> gauge(document.root().table("g"), context);
  document.finish();
  const auto row = gauge.read(flow);
  ASSERT_EQ(row.size(), gauge.columns().size());
  EXPECT_NEAR(row[0], 0.3, 0.1 * width);
  EXPECT_NEAR(row[1], 1800, 0.05 * 1800);
  EXPECT_NEAR(row[2], 0.3 + 0.08 * std::sqrt(std::log(2)), 0.25 * width);
}

}  // namespace
}  // namespace undine
