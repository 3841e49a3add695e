#include "undine/schemes/state_error.hpp"

#include <gtest/gtest.h>

#include "unit/schemes/flow.hpp"
#include "unit/schemes/gas_flow.hpp"

// What the moves say of a state that they cannot go on from, and that the flow is still there to be looked at.

namespace undine {
namespace {

using namespace field;
using integrators::Leapfrog;

/// What an action complains of.
template <class Action>
std::optional<StateError> error_of(Action&& action) {
  try {
    action();
  } catch (const StateError& error) {
    return error;
  }
  return {};
}

TEST(StateError, OfTheFirstRatesLeavesTheFlow) {
  test::PeriodicSquare square;
  auto store = square.store();
  store.get<rho>()[11] = 1e63;  // its pressure is beyond all numbers
  const auto id = store.ids()[11];
  WeaklyCompressible<2> flow(std::move(store), square.domain(), test::liquid<2>(square.support), unstarted);
  EXPECT_EQ(flow.neighbours().support(), 0);
  const auto error = error_of([&] { flow.start(); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->trouble(), Trouble::not_finite);
  EXPECT_GE(error->particle(), 0);
  EXPECT_EQ(flow.store().size(), 400u);
  EXPECT_GT(flow.neighbours().support(), 0);
  const auto found = std::ranges::find(flow.store().ids(), id) - flow.store().ids().begin();
  EXPECT_EQ(flow.store().get<rho>()[static_cast<std::size_t>(found)], 1e63);
}

TEST(StateError, StartedLaterItIsTheSameFlow) {
  test::PeriodicSquare square;
  WeaklyCompressible<2> at_once(square.store(), square.domain(), test::liquid<2>(square.support));
  WeaklyCompressible<2> later(square.store(), square.domain(), test::liquid<2>(square.support), unstarted);
  later.start();
  for (std::size_t i = 0; i < at_once.store().size(); ++i)
    EXPECT_EQ(norm(at_once.store().get<acc>()[i] - later.store().get<acc>()[i]), 0);
}

TEST(StateError, NamesWhoLeftTheDomain) {
  test::PeriodicSquare square;
  Domain<2> domain = square.domain();
  domain.periodic[1] = false;
  WeaklyCompressible<2> flow(square.store(), domain, test::liquid<2>(square.support));
  flow.store().get<x>()[5][1] = 1.5;
  const auto error = error_of([&] { flow.evaluate(); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->trouble(), Trouble::outside);
  EXPECT_EQ(error->particle(), flow.store().ids()[5]);
}

TEST(StateError, NamesGasWithoutEnergyAndWithoutRoomForItsSupport) {
  const double spacing = 1.0 / 12, support = 2.4 * spacing;
  auto options = test::gas<2>(support, spacing);
  Gas<2> flow(test::gas_store(test::gas_box<2>(12, support, 3)), test::unit_box<2>(), options);
  flow.store().get<e>()[9] = -1;
  auto error = error_of([&] { flow.evaluate(); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->trouble(), Trouble::energy);
  EXPECT_EQ(error->particle(), flow.store().ids()[9]);
  flow.store().get<e>()[9] = std::nan("");
  EXPECT_EQ(error_of([&] { flow.evaluate(); })->trouble(), Trouble::not_finite);
  flow.store().get<e>()[9] = 1;

  // With H by the density, a particle of a thousandth of its density reaches beyond half the period.
  test::take_symmetric_forms(options);
  options.smoothing = SmoothingLaw::density;
  test::GasParticles<2> all = test::gas_box<2>(12, support, 3);
  auto store = test::gas_store(all);
  store.get<rho>()[4] *= 1e-3;
  const auto id = store.ids()[4];
  Gas<2> thin(std::move(store), test::unit_box<2>(), options, unstarted);
  error = error_of([&] { thin.start(); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->trouble(), Trouble::support);
  EXPECT_EQ(error->particle(), id);
}

}  // namespace
}  // namespace undine
