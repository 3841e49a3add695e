#include <algorithm>

#include <gtest/gtest.h>

#include "unit/schemes/gas_flow.hpp"
#include "unit/under_sanitizer.hpp"

// A point explosion in a periodic box, in whose middle H grows to several times that of its shell.

namespace undine {
namespace {

using namespace field;

constexpr int side = 10;
constexpr double spacing = 1.0 / side, q = 2.4;

Store<3> cold_gas_with_a_hot_middle() {
  auto all = test::gas_box<3>(side, q * spacing, 5, 0.1);
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    const Vec<3> from_middle = all.x[i] - Vec<3>{{0.5, 0.5, 0.5}};
    all.v[i] = {};
    all.rho[i] = 1;
    all.m[i] = spacing * spacing * spacing;
    all.e[i] = 1e-4 + 1000 * std::exp(-norm_sq(from_middle) / sq(1.2 * spacing));
    all.h[i] = q * spacing;
  }
  return test::gas_store(all);
}

GasOptions<3> blast_options() {
  auto options = test::gas<3>(q * spacing, spacing);
  options.backend.precision = PairPrecision::mixed;
  options.artificial.emplace(terms::GasViscositySignal{});
  options.viscosity_switch.choose(terms::ViscositySwitches::index<terms::SwitchCullenDehnen>());
  options.conductivity.emplace();
  return options;
}

void run(Gas<3>& flow, int steps) {
  for (int k = 0; k < steps; ++k) integrators::Leapfrog::step(flow, flow.stable_step({.courant = 0.2}).dt);
}

void expect_same(const Gas<3>& a, const Gas<3>& b) {
  EXPECT_TRUE(std::ranges::equal(a.store().ids(), b.store().ids()));
  for (const int f : {x::id, v::id, h::id, e::id, rho::id, acc::id})
    EXPECT_TRUE(std::ranges::equal(a.store().raw(f), b.store().raw(f))) << all_fields[static_cast<std::size_t>(f)].name;
  EXPECT_EQ(a.memory(), b.memory());
}

/// The largest H over the smallest.
double spread(const Gas<3>& flow) {
  const auto [low, high] = std::ranges::minmax(flow.store().get<h>());
  return high / low;
}

constexpr int half = 15;

// Criterion: after each of 30 steps (each fifth under sanitizers) every pair nearer than the larger H of the two is on
// the lists of both, while H comes to differ by more than a factor of two; whatever the mean of the supports.
TEST(GasBlast, ListsMissNoPair) {
  const test::Threads one(1);
  for (const auto mean : {Symmetrisation::arithmetic, Symmetrisation::gradients}) {
    auto options = blast_options();
    options.support.mean = mean;
    Gas<3> flow(cold_gas_with_a_hot_middle(), test::unit_box<3>(), options);
    for (int k = 0; k < 2 * half; ++k) {
      run(flow, 1);
      if (test::under_sanitizer && k % 5 != 4) continue;
      const auto at = flow.store().get<x>();
      const auto H = flow.store().get<h>();
      Neighbours<3>::Scratch scratch;
      for (std::size_t a = 0; a < at.size(); ++a) {
        const auto list = flow.neighbours().of(Group::fluid, a, Group::fluid, flow.store(), scratch);
        std::size_t missed = 0;
        for (std::uint32_t b = 0; b < at.size(); ++b)
          if (norm(flow.domain().nearest_image(at[a] - at[b])) < std::max(H[a], H[b]))
            missed += !std::ranges::binary_search(list, b);
        ASSERT_EQ(missed, 0U) << "step " << k;
      }
    }
    EXPECT_GT(spread(flow), 2);
  }
}

// Criterion: the same bits on one thread and on three, by every way to the lists, and by a run that goes on from its
// memory half-way.
TEST(GasBlast, IsTheSameBitsByEveryWay) {
  const auto start = cold_gas_with_a_hot_middle();
  const auto options = blast_options();
  const auto box = test::unit_box<3>();
  Gas<3> whole(Store<3>(start), box, options);
  {
    const test::Threads one(1);
    run(whole, half);
    Gas<3> second(Store<3>(whole.store()), box, options, whole.memory());
    run(whole, half);
    run(second, half);
    EXPECT_GT(spread(whole), 2);
    expect_same(whole, second);
  }
  const test::Threads three(3);
  for (const Lists lists : {Lists::stored, Lists::free, Lists::plain}) {
    auto other = options;
    other.neighbours.lists = lists;
    if (lists == Lists::plain) other.neighbours.search = "octree";
    Gas<3> flow(Store<3>(start), box, other);
    run(flow, 2 * half);
    expect_same(whole, flow);
  }
}

}  // namespace
}  // namespace undine
