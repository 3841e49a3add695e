#include "undine/app/watchdog/watch.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "undine/app/watchdog/pair_survey.hpp"
#include "undine/schemes/state_error.hpp"
#include "unit/schemes/flow.hpp"
#include "unit/schemes/gas_flow.hpp"

namespace undine {
namespace {

using namespace field;
using integrators::Leapfrog;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A square of disordered particles and its watchdog.
struct Watched {
  test::PeriodicSquare square;
  WatchLimits limits;
  WeaklyCompressible<2> flow{square.store(), square.domain(), test::liquid<2>(square.support)};
  Watch<2> watch{limits, {.spacing = square.spacing, .largest_step = 1e-3}, flow.options().materials};

  Alarm alarm(auto&& look) {
    try {
      look();
    } catch (const AlarmError& error) {
      particle = error.hit().particle;
      return error.hit().alarm;
    }
    throw std::logic_error("no alarm");
  }
  std::int64_t particle = -1;
};

TEST(Watch, IsSilentWhileAllIsWell) {
  Watched run;
  run.watch.begin(run.flow);
  for (int k = 0; k < 50; ++k) {
    Leapfrog::step(run.flow, 2e-4);
    EXPECT_NO_THROW(run.watch.quickly(run.flow));
    EXPECT_NO_THROW(run.watch.step(run.flow, {2e-4, "courant"}));
  }
  EXPECT_NO_THROW(run.watch.fully(run.flow));
}

TEST(Watch, SeesDensitiesBeyondBoundsAndThoseThatAreNone) {
  Watched run;
  run.flow.store().get<rho>()[7] = 1600;
  run.flow.store().get<rho>()[9] = 1550;
  EXPECT_EQ(run.alarm([&] { run.watch.quickly(run.flow); }), Alarm::density);
  EXPECT_EQ(run.particle, run.flow.store().ids()[7]);  // the worst
  run.flow.store().get<rho>()[9] = 400;
  run.flow.store().get<rho>()[7] = 1400;
  EXPECT_EQ(run.alarm([&] { run.watch.quickly(run.flow); }), Alarm::density);
  EXPECT_EQ(run.particle, run.flow.store().ids()[9]);
  run.flow.store().get<rho>()[3] = nan;
  EXPECT_EQ(run.alarm([&] { run.watch.quickly(run.flow); }), Alarm::not_finite);
  EXPECT_EQ(run.particle, run.flow.store().ids()[3]);
}

TEST(Watch, LetsASummedDensityBeLowAndAGasBeAnything) {
  Watched run;
  run.flow.store().get<rho>()[9] = 200;
  Watch<2> summed(run.limits, {.spacing = run.square.spacing, .summed = true}, run.flow.options().materials);
  EXPECT_NO_THROW(summed.quickly(run.flow));
  run.flow.store().get<rho>()[9] = 5000;
  EXPECT_EQ(run.alarm([&] { summed.quickly(run.flow); }), Alarm::density);
  const materials::Material gas{.name = "gas", .rho_0 = 1000, .mu = 0, .eos = materials::Isothermal{}};
  Watch<2> gases(run.limits, {.spacing = run.square.spacing}, {gas});
  EXPECT_NO_THROW(gases.quickly(run.flow));
}

TEST(Watch, SeesWhatIsNotFiniteOrOutside) {
  Watched run;
  run.flow.store().get<v>()[4][1] = nan;
  EXPECT_EQ(run.alarm([&] { run.watch.fully(run.flow); }), Alarm::not_finite);
  EXPECT_EQ(run.particle, run.flow.store().ids()[4]);

  // Along x the square ends now.
  test::PeriodicSquare square;
  Domain<2> domain = square.domain();
  domain.periodic[0] = false;
  WeaklyCompressible<2> flow(square.store(), domain, test::liquid<2>(square.support));
  Watch<2> watch({}, {.spacing = square.spacing}, flow.options().materials);
  EXPECT_NO_THROW(watch.fully(flow));
  flow.store().get<x>()[11][0] = 1.01;
  EXPECT_EQ(run.alarm([&] { watch.fully(flow); }), Alarm::outside);
  EXPECT_EQ(run.particle, flow.store().ids()[11]);
}

TEST(Watch, SeesParticlesThatLieOnEachOtherAcrossAPeriodToo) {
  Watched run;
  auto at = run.flow.store().get<x>();
  const auto j = run.flow.neighbours().of(Group::fluid, 0, Group::fluid, run.flow.store(),
                                          *std::make_unique<Neighbours<2>::Scratch>());
  std::size_t other = 0;
  for (const std::uint32_t k : j)
    if (k != 0) other = k;
  at[other] = at[0];
  at[other][0] += 1 + 1e-4 * run.square.spacing;  // one period away
  EXPECT_NEAR(survey_pairs(run.flow, run.square.spacing).closest, 1e-4, 1e-9);
  EXPECT_NEAR(survey_pairs(run.flow, run.square.spacing).distance, 1e-4 * run.square.spacing, 1e-12);
  EXPECT_EQ(survey_pairs(run.flow, run.square.spacing).clumped, 2u);
  EXPECT_EQ(survey_pairs(run.flow, run.square.spacing).coincident, 2u);
  EXPECT_NO_THROW(run.watch.fully(run.flow));  // one pair among 400
  Watch<2> strict({.coincident = 0}, {.spacing = run.square.spacing}, run.flow.options().materials);
  EXPECT_EQ(run.alarm([&] { strict.fully(run.flow); }), Alarm::coincidence);
}

TEST(Watch, SeesClumpsBeforeTheyCoincide) {
  Watched run;
  auto at = run.flow.store().get<x>();
  const auto scratch = std::make_unique<Neighbours<2>::Scratch>();
  std::vector<char> paired(at.size(), 0);
  for (std::size_t i = 0; i < 120; ++i)
    for (const std::uint32_t j : run.flow.neighbours().of(Group::fluid, i, Group::fluid, run.flow.store(), *scratch)) {
      if (j == i || paired[i] || paired[j]) continue;
      at[j] = at[i] + Vec<2>{{0.25 * run.square.spacing, 0}};
      paired[i] = paired[j] = 1;
    }
  EXPECT_GT(survey_pairs(run.flow, run.square.spacing).closest, 0.01);
  EXPECT_EQ(run.alarm([&] { run.watch.fully(run.flow); }), Alarm::coincidence);
}

TEST(Watch, SeesAResidualThatJumpsButNotEnergyThatIsBooked) {
  Watched run;
  run.watch.begin(run.flow);
  for (auto& u : run.flow.store().get<v>()) u = 1.2 * u;  // 44 % more kinetic energy, from nowhere
  EXPECT_EQ(run.alarm([&] { run.watch.fully(run.flow); }), Alarm::residual);
  Watch<2> open({}, {.spacing = run.square.spacing, .audited = false}, run.flow.options().materials);
  open.begin(run.flow);
  for (auto& u : run.flow.store().get<v>()) u = 1.2 * u;
  EXPECT_NO_THROW(open.fully(run.flow));
}

TEST(Watch, SeesAStepThatCollapses) {
  Watched run;
  EXPECT_NO_THROW(run.watch.step(run.flow, {1e-6, "force"}));
  EXPECT_EQ(run.alarm([&] { run.watch.step(run.flow, {0.9e-7, "force"}); }), Alarm::step_collapse);
  EXPECT_EQ(run.alarm([&] { run.watch.step(run.flow, {nan, "force"}); }), Alarm::step_collapse);
  EXPECT_EQ(run.alarm([&] { run.watch.step(run.flow, {0, "force"}); }), Alarm::step_collapse);
}

TEST(Watch, SwitchedOffSaysNothing) {
  Watched run;
  Watch<2> off({.active = false}, {.spacing = run.square.spacing, .largest_step = 1e-3}, run.flow.options().materials);
  run.flow.store().get<rho>()[7] = 1e9;
  off.begin(run.flow);
  EXPECT_NO_THROW(off.fully(run.flow));
  EXPECT_NO_THROW(off.step(run.flow, {1e-9, "force"}));
}

TEST(Watch, FindsInAStateWhatAnErrorOfTheMovesWasAbout) {
  Watched run;
  const RunError error({.what = "the moves cannot go on"});
  EXPECT_FALSE(hit_of(error, run.flow).has_value());
  run.flow.store().get<acc>()[5][0] = nan;
  EXPECT_EQ(hit_of(error, run.flow)->alarm, Alarm::not_finite);
  EXPECT_EQ(hit_of(error, run.flow)->particle, run.flow.store().ids()[5]);
  // What the error says goes before what can be seen.
  EXPECT_EQ(hit_of(StateError(Trouble::support, 7, {.what = "no support"}), run.flow)->alarm, Alarm::support);
  EXPECT_EQ(hit_of(StateError(Trouble::energy, 7, {.what = "no energy"}), run.flow)->alarm, Alarm::energy);
  EXPECT_EQ(hit_of(StateError(Trouble::outside, 7, {.what = "gone"}), run.flow)->alarm, Alarm::outside);
  EXPECT_EQ(hit_of(StateError(Trouble::not_finite, 7, {.what = "nan"}), run.flow)->particle, 7);
}

/// A periodic square of disordered gas and its watchdog.
struct WatchedGas {
  static constexpr int side = 16;
  double spacing = 1.0 / side, support = 2.6 * spacing;
  GasOptions<2> options = test::gas<2>(support, spacing);
  Gas<2> flow{test::gas_store(test::gas_box<2>(side, support, 5)), test::unit_box<2>(), options};
  WatchLimits limits;
  Watch<2> watch{limits, {.spacing = spacing, .courant_h = 0.3 * support / 2, .summed = true}, options.materials};

  std::optional<AlarmHit> hit(auto&& look) {
    try {
      look();
    } catch (const AlarmError& error) {
      return error.hit();
    }
    return {};
  }
};

// Criterion: none of the looks finds fault with gas that moves, is compressed to four times its density and audited.
TEST(WatchGas, IsSilentWhileAllIsWell) {
  WatchedGas run;
  run.watch.begin(run.flow);
  for (int k = 0; k < 10; ++k) {
    const Step step = run.flow.stable_step({.courant = 0.3});
    EXPECT_NO_THROW(run.watch.step(run.flow, step));
    Leapfrog::step(run.flow, step.dt);
    EXPECT_NO_THROW(run.watch.quickly(run.flow));
  }
  EXPECT_NO_THROW(run.watch.fully(run.flow));
  for (auto& density : run.flow.store().get<rho>()) density *= 4;
  EXPECT_NO_THROW(run.watch.quickly(run.flow));
}

TEST(WatchGas, SeesEnergiesBelowZeroAndThoseThatAreNone) {
  WatchedGas run;
  run.flow.store().get<e>()[7] = -1e-9;
  auto hit = run.hit([&] { run.watch.fully(run.flow); });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->alarm, Alarm::energy);
  EXPECT_EQ(hit->particle, run.flow.store().ids()[7]);
  run.flow.store().get<e>()[7] = nan;
  hit = run.hit([&] { run.watch.fully(run.flow); });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->alarm, Alarm::not_finite);
}

// Criterion: distances count in the room that particles take: a tenth of the case's spacing is no coincidence where
// gas is a hundred times as dense in 2-D, and is one where it is not.
TEST(WatchGas, SeesParticlesThatCoincideForTheRoomThatTheyTake) {
  WatchedGas run;
  run.limits.coincident = 0;
  run.limits.closest = 0.2;
  Watch<2> strict(run.limits, {.spacing = run.spacing, .summed = true}, run.options.materials);
  auto at = run.flow.store().get<x>();
  std::vector<std::uint32_t> scratch;
  std::size_t other = 0;
  for (const std::uint32_t j : run.flow.neighbours().of(Group::fluid, 0, Group::fluid, run.flow.store(), scratch))
    if (j != 0) other = j;
  at[other] = at[0] + Vec<2>{{0.1 * run.spacing, 0}};
  const auto hit = run.hit([&] { strict.fully(run.flow); });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->alarm, Alarm::coincidence);
  for (const std::size_t i : {std::size_t{0}, other}) run.flow.store().get<rho>()[i] *= 100;
  EXPECT_NO_THROW(strict.fully(run.flow));
}

TEST(WatchGas, SeesParticlesThatHaveLostTheirNeighbours) {
  WatchedGas run;
  auto H = run.flow.store().get<h>();
  for (std::size_t i = 0; i < H.size() / 10; ++i) H[i] = 0.1 * run.spacing;
  EXPECT_NO_THROW(run.watch.fully(run.flow));  // a tenth
  for (std::size_t i = 0; i < H.size() / 3; ++i) H[i] = 0.1 * run.spacing;
  const auto hit = run.hit([&] { run.watch.fully(run.flow); });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->alarm, Alarm::isolated);
}

TEST(WatchGas, SeesEnergyFromNowhere) {
  WatchedGas run;
  run.watch.begin(run.flow);
  for (auto& energy : run.flow.store().get<e>()) energy *= 1.5;
  const auto hit = run.hit([&] { run.watch.fully(run.flow); });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->alarm, Alarm::residual);
}

// Criterion: 1e-4 of the step that the energy per mass allows when it is evenly spread: 0.3 h / sqrt(2 E/M) with
// h = 0.08 m and e near 2 J/kg is 12 ms. Without a look there is nothing to compare with.
TEST(WatchGas, SeesAStepThatCollapses) {
  WatchedGas run;
  EXPECT_NO_THROW(run.watch.step(run.flow, {1e-12, "courant"}));
  run.watch.begin(run.flow);
  EXPECT_NO_THROW(run.watch.step(run.flow, {1.5e-6, "courant"}));
  const auto hit = run.hit([&] { run.watch.step(run.flow, {0.9e-6, "courant"}); });
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->alarm, Alarm::step_collapse);
}

}  // namespace
}  // namespace undine
