#include "undine/app/watchdog/watch.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "undine/app/watchdog/pair_survey.hpp"
#include "unit/schemes/flow.hpp"

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
  EXPECT_NEAR(survey_pairs(run.flow, run.square.spacing).closest, 1e-4 * run.square.spacing, 1e-12);
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
  EXPECT_GT(survey_pairs(run.flow, run.square.spacing).closest, 0.01 * run.square.spacing);
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
  EXPECT_FALSE(hit_of_state(run.flow).has_value());
  run.flow.store().get<acc>()[5][0] = nan;
  EXPECT_EQ(hit_of_state(run.flow)->alarm, Alarm::not_finite);
  EXPECT_EQ(hit_of_state(run.flow)->particle, run.flow.store().ids()[5]);
}

}  // namespace
}  // namespace undine
