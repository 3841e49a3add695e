#include <gmock/gmock.h>

#include "undine/analysis/norms.hpp"
#include "undine/app/gauges/error.hpp"
#include "undine/io/case/document.hpp"
#include "undine/schemes/weakly_compressible.hpp"
#include "unit/io/io_test.hpp"

namespace undine {
namespace {

using namespace field;
using test::error_of;
using ::testing::HasSubstr;

/// 20 x 20 particles in the periodic unit square, every other one of half the mass, with states of a given formula.
struct Square {
  GaugeContext<2> context{.spacing = 0.05, .interval = 0.1, .gravity = {{0, -9.81}}};
  std::unique_ptr<WeaklyCompressible<2>> flow;

  explicit Square(auto&& state) {
    context.domain = {{{0, 0}}, {{1, 1}}, {true, true}};
    Store<2> store;
    store.allocate(Fields<x, v, m, rho, h, rho_0, mu, p, x_list>::set());
    store.append(Group::fluid, 400, 0);
    for (std::size_t i = 0; i < 400; ++i) {
      const auto column = static_cast<double>(i % 20), row = static_cast<double>(i / 20);
      store.get<x>()[i] = {{(column + 0.5) * 0.05, (row + 0.5) * 0.05}};
      store.get<m>()[i] = 1000 * sq(0.05) * (i % 2 ? 1 : 0.5);
      store.get<rho>()[i] = store.get<rho_0>()[i] = 1000;
      store.get<h>()[i] = 0.13;
      state(store, i);
    }
    WeaklyCompressibleOptions<2> options;
    options.support = {.uniform = 0.13, .kappa = 2};
    options.wall_density = walls::WallDensity::none;
    options.materials = {{.eos = materials::Linear{.rho_0 = 1000, .c_0 = 30}}};
    options.backend.precision = PairPrecision::double_precision;
    flow = std::make_unique<WeaklyCompressible<2>>(std::move(store), context.domain, options);
  }

  std::vector<double> read(const std::string& text) const {
    const Document document = Document::parse("[g]\n" + text, "case.toml");
    const ErrorGauge<2> gauge(document.root().table("g"), context);
    document.finish();
    const std::vector<double> row = gauge.read(*flow);
    EXPECT_EQ(row.size(), gauge.columns().size());
    return row;
  }
  std::string error(const std::string& text) const {
    return error_of([&] { read(text); });
  }
};

/// Taylor-Green velocities with U = 2, L = 1.
Square vortices() {
  return Square([](auto& store, std::size_t i) {
    const Vec<2> at = store.template get<x>()[i];
    const double k = 2 * exact::pi;
    store.template get<v>()[i] = {
        {-2 * std::cos(k * at[0]) * std::sin(k * at[1]), 2 * std::sin(k * at[0]) * std::cos(k * at[1])}};
  });
}

const std::string vortex = "exact = \"taylor_green\"\nparameters = { speed = 2, density = 1000, viscosity = 1 }\n";

TEST(ErrorGauge, FindsNoneInTheSolutionItself) {
  for (const double norm : vortices().read(vortex + "fields = [\"velocity\", \"velocity_x\", \"velocity_y\"]"))
    EXPECT_NEAR(norm, 0, 1e-14);
}

// A later time of the solution has decayed by e^(bt): the error is its lack, weighted by the volumes of the particles.
TEST(ErrorGauge, WeighsWithVolumes) {
  const Square square = vortices();
  const double decay = std::exp(-2 * sq(2 * exact::pi) * 1e-3 * 3), lack = 1 - decay;
  const auto row = square.read(vortex + "time_shift = \"3 s\"\nfields = [\"velocity\", \"velocity_y\"]");
  NormSums whole, second;
  for (std::size_t i = 0; i < 400; ++i) {
    const Vec<2> velocity = square.flow->store().get<v>()[i];
    const double volume = square.flow->store().get<m>()[i] / 1000;
    whole.add(volume, lack * norm(velocity), decay * norm(velocity));
    second.add(volume, lack * velocity[1], decay * velocity[1]);
  }
  const auto expect = [&](const Norms& n, std::size_t k) {
    EXPECT_NEAR(row[k], n.l1, 1e-12);
    EXPECT_NEAR(row[k + 1], n.l2, 1e-12);
    EXPECT_NEAR(row[k + 2], n.linf, 1e-12);
    EXPECT_NEAR(row[k + 3], lack / decay, 1e-12);
  };
  expect(whole.norms(), 0);
  expect(second.norms(), 4);
}

TEST(ErrorGauge, TurnsAndMovesTheSolution) {
  // Poiseuille flow along -y between x = 0.25 and x = 0.75.
  const double F = 8, nu = 1;
  const Square square([&](auto& store, std::size_t i) {
    const double X = store.template get<x>()[i][0] - 0.25;
    if (X > 0 && X < 0.5) store.template get<v>()[i] = {{0, -F / (2 * nu) * X * (0.5 - X)}};
  });
  const std::string text =
      "exact = \"poiseuille\"\nparameters = { force = 8, width = 0.5, density = 1, viscosity = 1 }\ntime_shift = 100\n"
      "axes = [\"-y\", \"x\"]\n";
  for (const double norm : square.read(text + "origin = [0.25, 0]")) EXPECT_NEAR(norm, 0, 1e-14);
  // Unmoved it is wrong, but right again in a region that leaves out where it is not.
  EXPECT_GT(square.read(text)[1], 0.01);
  const std::string still = "origin = [5, 0]\nregion = { type = \"box\", low = [0, 0], high = [0.25, 1] }";
  for (const double norm : square.read(text + still)) EXPECT_NEAR(norm, 0, 1e-14);
}

TEST(ErrorGauge, PutsAColumnUprightAndTakesOffTheMeanPressure) {
  const Square square([](auto& store, std::size_t i) {
    const double p_exact = 9810 * (1 - store.template get<x>()[i][1]);
    store.template get<rho>()[i] = 1000 + (p_exact + 500) / 900;
  });
  // Pressure is what the flow keeps of the density, which its equation of state gives.
  const std::string text = "exact = \"hydrostatic_incompressible\"\nfields = [\"pressure\"]\n";
  square.flow->evaluate();
  const auto row = square.read(text);
  EXPECT_NEAR(row[0], 500, 1e-6);
  EXPECT_NEAR(row[1], 500, 1e-6);
  EXPECT_NEAR(row[2], 500, 1e-6);
  for (const double norm : square.read(text + "without_mean_pressure = true")) EXPECT_NEAR(norm, 0, 1e-6);
}

TEST(ErrorGauge, PointsAwayFromACentreAcrossTheSeam) {
  // Noh's gas runs to the corner of the periodic square.
  const Square square([](auto& store, std::size_t i) {
    Vec<2> d = store.template get<x>()[i];
    for (int k = 0; k < 2; ++k) d[k] -= std::round(d[k]);
    store.template get<v>()[i] = -3 / norm(d) * d;
    store.template get<rho>()[i] = 1000;
  });
  const std::string text = "exact = \"noh\"\nparameters = { density = 1000, speed = 3 }\n";
  for (const double norm : square.read(text + "fields = [\"velocity\", \"density\"]")) EXPECT_NEAR(norm, 0, 1e-12);
}

TEST(ErrorGauge, SaysWhatItCannotCompare) {
  const Square square = vortices();
  EXPECT_THAT(square.error("exact = \"taylor_gren\""), HasSubstr("did you mean 'taylor_green'?"));
  EXPECT_THAT(square.error("exact = \"drop_oscillation\""), HasSubstr("drop_oscillation"));
  EXPECT_THAT(square.error("exact = \"cavity\""), HasSubstr("cavity"));
  EXPECT_THAT(square.error(vortex + "fields = [\"density\"]"), HasSubstr("density"));
  EXPECT_THAT(square.error(vortex + "fields = []"), HasSubstr("empty"));
  EXPECT_THAT(square.error(vortex + "axes = [\"x\"]"), HasSubstr("2 of 'axes', not 1"));
  EXPECT_THAT(square.error(vortex + "axes = [\"x\", \"-x\"]"), HasSubstr("same line"));
  EXPECT_THAT(square.error("exact = \"noh\"\nparameters = { dimensions = 3 }"), HasSubstr("3 dimensions, the case 2"));
  EXPECT_THAT(square.error("exact = \"noh\"\nparameters = { gamma = 1 }"), HasSubstr("gamma is not above 1"));
  EXPECT_THAT(square.error("exact = \"noh\"\nparameters = { gama = 1.4 }"), HasSubstr("gamma"));
  EXPECT_THAT(square.error("exact = \"noh\"\nparameters = { speed = \"1 m\" }"), HasSubstr("velocity"));
}

}  // namespace
}  // namespace undine
