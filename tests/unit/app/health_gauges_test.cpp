#include <cmath>

#include <gtest/gtest.h>

#include "undine/app/gauges.hpp"
#include "undine/io/case/document.hpp"
#include "undine/schemes/weakly_compressible.hpp"
#include "unit/io/io_test.hpp"

namespace undine {
namespace {

using test::error_of;
using test::TemporaryFolder;

/// Two fluids in the box [0, 1] x [0, 1], particle by particle, without walls of particles and without neighbours'
/// forces.
struct Box {
  static constexpr double spacing = 0.1;
  GaugeContext<2> context{.spacing = spacing, .interval = 1};
  Store<2> store;

  Box() {
    auto walls = std::make_shared<ReflectingSurface>();
    context.container.include(Vec3{0, 0, 0});
    context.container.include(Vec3{1, 1, 0});
    walls->add_tank(context.container, 2);
    context.walls = walls;
    context.gravity = {{0, -9.81}};
    context.support = 0.26;
    context.materials = {"water", "glycerin"};
    context.rest_densities = {1000, 1260};
    for (int k = 0; k < 2; ++k) {
      context.domain.low[k] = -2;
      context.domain.high[k] = 3;
    }
    using namespace field;
    store.allocate(Fields<x, v, m, rho, h, rho_0, mu, p, x_list>::set());
  }

  void put(const Vec<2>& at, int material = 0, const Vec<2>& velocity = {}) {
    const std::size_t i = store.append(Group::fluid, 1, material);
    store.get<field::x>()[i] = at;
    store.get<field::v>()[i] = velocity;
    store.get<field::rho>()[i] = store.get<field::rho_0>()[i] =
        context.rest_densities[static_cast<std::size_t>(material)];
    store.get<field::m>()[i] = context.rest_densities[static_cast<std::size_t>(material)] * spacing * spacing;
    store.get<field::h>()[i] = context.support;
  }

  /// A row of cells full of one material, bottom at y = low, top at y = high.
  void fill(double low, double high, int material) {
    for (double y = low + spacing / 2; y < high; y += spacing)
      for (double x = spacing / 2; x < 1; x += spacing) put({{x, y}}, material);
  }

  std::vector<double> read(const std::string& text) {
    WeaklyCompressibleOptions<2> options;
    options.support = {.uniform = context.support, .kappa = 2};
    options.materials = {{.eos = materials::Linear{.rho_0 = 1000, .c_0 = 30}},
                         {.rho_0 = 1260, .eos = materials::Linear{.rho_0 = 1260, .c_0 = 30}}};
    options.backend.precision = PairPrecision::double_precision;
    WeaklyCompressible<2> flow(store, context.domain, options);
    const TemporaryFolder folder;
    const Document document = Document::parse("[[gauge]]\nname = \"g\"\n" + text, folder / "case.toml");
    GaugeSet<2> set(document.root(), context);
    document.finish();
    set.create(folder.path());
    set.sample(flow);
    std::vector<double> row;
    for (const CsvColumn& column : read_csv(folder / "gauges/g.csv").columns) row.push_back(column.values.at(0));
    return {row.begin() + 1, row.end()};
  }
};

TEST(LeakGauge, CountsWhatIsHalfASpacingBehindAWall) {
  Box box;
  box.put({{0.5, 0.5}});
  box.put({{0.5, -0.04}});  // behind, but by less than half a spacing
  box.put({{0.5, -0.06}});
  box.put({{1.3, 0.5}});
  const auto row = box.read("type = \"leak\"");
  EXPECT_EQ(row[0], 2);
  EXPECT_DOUBLE_EQ(row[1], 0.5);
  EXPECT_NEAR(row[2], 0.3, 1e-12);
  EXPECT_EQ(box.read("type = \"leak\"\nbeyond = 1")[0], 1);
}

TEST(WallMotionGauge, IsTheRmsSpeedNearTheWalls) {
  Box box;
  box.put({{0.5, 0.5}}, 0, {{100, 0}});  // far from every wall
  box.put({{0.1, 0.5}}, 0, {{3, 4}});
  box.put({{0.9, 0.5}}, 0, {{0, 0}});
  const auto row = box.read("type = \"wall_motion\"");
  EXPECT_EQ(row[1], 2);
  EXPECT_NEAR(row[0], std::sqrt(25.0 / 2), 1e-12);
  EXPECT_EQ(box.read("type = \"wall_motion\"\nwithin = 0.6")[1], 3);
}

TEST(CoincidenceGauge, CountsPairsAndFindsTheClosest) {
  Box box;
  box.fill(0, 0.5, 0);
  const auto apart = box.read("type = \"coincidence\"");
  EXPECT_EQ(apart[0], 0);
  EXPECT_NEAR(apart[1], 1, 1e-9);
  box.put({{0.505, 0.705}});
  box.put({{0.505, 0.708}});
  box.put({{0.507, 0.705}});
  const auto row = box.read("type = \"coincidence\"");
  EXPECT_EQ(row[0], 3);
  EXPECT_NEAR(row[1], 0.02, 1e-9);
  EXPECT_EQ(box.read("type = \"coincidence\"\ncloser_than = 0.025")[0], 1);
}

TEST(MeanDensityGauge, ALatticeHasItsDensityInBothWays) {
  Box box;
  box.fill(0, 0.6, 0);
  const auto row = box.read("type = \"mean_density\"");
  EXPECT_NEAR(row[0], 1000, 1e-9);
  EXPECT_NEAR(row[1], 1000, 1e-6);
  EXPECT_NEAR(row[2], 0.6, 1e-9);
  box.put({{0.5, 0.95}});  // a drop: mass grows by 1/60, height by less than a tenth of a spacing
  EXPECT_NEAR(box.read("type = \"mean_density\"")[2], 0.6, 0.1 * Box::spacing + 0.01);
  EXPECT_NEAR(box.read("type = \"mean_density\"\nbase = 2")[1] / box.read("type = \"mean_density\"")[1], 0.5, 1e-12);
}

TEST(MeanDensityGauge, HalfTheHeightIsTwiceTheDensity) {
  Box box;
  box.fill(0, 0.6, 0);
  for (auto& x : box.store.get<field::x>()) x[1] *= 0.5;
  const auto row = box.read("type = \"mean_density\"");
  EXPECT_NEAR(row[0], 1000, 1e-9);  // what particles carry does not see it
  EXPECT_NEAR(row[2], 0.3, 0.05 * Box::spacing + 0.005);
  EXPECT_NEAR(row[1], 2000, 40);
}

TEST(CentreOfMassGauge, OfAllAndOfEachFluid) {
  Box box;
  box.put({{0.2, 0.4}}, 0);
  box.put({{0.6, 0.4}}, 0);
  box.put({{0.6, 0.8}}, 1);
  const auto row = box.read("type = \"centre_of_mass\"");
  EXPECT_NEAR(row[0], (0.2 + 0.6 + 1.26 * 0.6) / 3.26, 1e-12);
  EXPECT_NEAR(row[2], 0.4, 1e-12);
  EXPECT_NEAR(row[4], 0.6, 1e-12);
  EXPECT_NEAR(row[5], 0.8, 1e-12);
}

TEST(MixedLayerGauge, IsZeroWhereFluidsAreApartAndTheThicknessOfALinearLayer) {
  Box apart;
  apart.fill(0, 0.4, 1);
  apart.fill(0.4, 0.8, 0);
  const auto none = apart.read("type = \"mixed_layer\"");
  EXPECT_NEAR(none[0], 0, 1e-9);
  EXPECT_NEAR(none[1], -0.04, 1e-6);  // 5 % of 0.4 m on either side

  // In rows 2 to 7 the share of water grows from 1/12 to 11/12: a straight line from 0.2 to 0.8 m, in steps of a row.
  Box mixed;
  mixed.fill(0, 0.2, 1);
  mixed.fill(0.8, 1.0, 0);
  for (int row = 2; row < 8; ++row)
    for (int k = 0; k < 12; ++k) mixed.put({{(k + 0.5) / 12, 0.1 * row + 0.05}}, k < 2 * (row - 2) + 1 ? 0 : 1);
  const auto layer = mixed.read("type = \"mixed_layer\"");
  EXPECT_NEAR(layer[0], 0.6, 0.02);
  // 5 % of the 56 particles of water are 2.8: one in the first row of the layer, 1.8 of 3 in the next: 0.36 m; the
  // glycerin is its mirror image at 0.5 m.
  EXPECT_NEAR(layer[1], 0.64 - 0.36, 1e-9);
}

TEST(MixedLayerGauge, NeedsTwoFluids) {
  Box box;
  box.context.materials = {"water"};
  box.context.rest_densities = {1000};
  box.put({{0.5, 0.5}});
  const auto message = error_of([&] { box.read("type = \"mixed_layer\""); });
  EXPECT_NE(message.find("a mixed layer needs two fluids"), std::string::npos) << message;
}

}  // namespace
}  // namespace undine
