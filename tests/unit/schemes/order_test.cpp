#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "unit/schemes/flow.hpp"

// Order of the integrators in time, at fixed resolution, on an oscillator made of particles: a standing sound wave on a
// periodic line.

namespace undine {
namespace {

using namespace field;

constexpr int particles = 40;
constexpr double spacing = 1.0 / particles, support = 2.6 * spacing;
constexpr double c_0 = 1, final_time = 0.4;  // 0.4 of the period

WeaklyCompressible<1> make_wave(DensityForm density, double viscosity = 0) {
  std::vector<Vec<1>> at;
  const double k = 2 * std::numbers::pi;
  for (int i = 0; i < particles; ++i) {
    const double lattice = (i + 0.5) * spacing;
    at.push_back({{lattice + 0.01 * std::sin(k * lattice)}});
  }
  auto store = test::empty_store<1>();
  test::add_particles(store, Group::fluid, at, spacing, support);
  for (int i = 0; i < particles; ++i) {
    store.get<rho>()[i] = 1000 / (1 + 0.01 * k * std::cos(k * (i + 0.5) * spacing));
    store.get<v>()[i][0] = 0.02 * std::cos(k * (i + 0.5) * spacing);
    store.get<mu>()[i] = viscosity;
  }
  auto options = test::liquid<1>(support);
  options.density = density;
  if (viscosity > 0) options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
  options.materials[0].eos = materials::TaitSoundSpeed{.rho_0 = 1000, .c_0 = c_0, .gamma = 7};
  return WeaklyCompressible<1>(std::move(store), Domain<1>{{{0}}, {{1}}, {true}}, options);
}

/// Positions, velocities and densities by particle id; positions as they are, unwrapped by the first ones.
std::vector<double> state_of(const WeaklyCompressible<1>& flow) {
  std::vector<double> state(3 * particles);
  for (std::size_t i = 0; i < particles; ++i) {
    const auto id = static_cast<std::size_t>(flow.store().ids()[i]);
    const double lattice = (static_cast<double>(id) + 0.5) * spacing;
    state[3 * id] = flow.domain().nearest_image(flow.store().get<x>()[i] - Vec<1>{{lattice}})[0];
    state[3 * id + 1] = flow.store().get<v>()[i][0];
    state[3 * id + 2] = flow.store().get<rho>()[i] / 1000;
  }
  return state;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += sq(a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

template <class Integrator>
std::vector<double> state_after(DensityForm density, int steps) {
  auto flow = make_wave(density);
  test::run_steps<Integrator>(flow, steps, final_time / steps);
  return state_of(flow);
}

constexpr DensityForm forms[] = {DensityForm::evolved, DensityForm::summation};
const char* name_of(DensityForm density) { return density == DensityForm::evolved ? "continuity" : "summation"; }

/// Steps that are short enough for the order to show, and long enough for rounding not to.
template <class Integrator>
constexpr int coarse_steps = Integrator::order > 3    ? 24
                             : Integrator::order == 3 ? 48
                                                      : 128;

// Criterion: halving the step divides the error by 2^order, order within 0.2 of what the integrator says, 0.3 above 2.
TEST(Order, IsWhatTheIntegratorsClaim) {
  const test::Threads one(1);
  for (const auto density : forms) {
    const auto exact = state_after<integrators::RungeKutta<integrators::Classical>>(density, 2048);
    integrators::Integrators::for_each([&]<class Integrator>(Integrator) {
      constexpr int steps = coarse_steps<Integrator>;
      const double coarse = distance(state_after<Integrator>(density, steps), exact);
      const double fine = distance(state_after<Integrator>(density, 2 * steps), exact);
      const double order = std::log2(coarse / fine);
      EXPECT_NEAR(order, Integrator::order, Integrator::order > 2 ? 0.3 : 0.2)
          << Integrator::info.name << ", " << name_of(density);
      std::printf("    %s, %s: order %.3f (error %.2g)\n", Integrator::info.name.data(), name_of(density), order, fine);
    });
  }
}

// Criterion: with viscosity, so that something is booked, the residual of the energy audit falls with the order of the
// integrator less 0.3, or is down at rounding (1e-13 of the energy that is booked).
TEST(Order, AccountsAreAsGoodAsTheState) {
  const test::Threads one(1);
  integrators::Integrators::for_each([&]<class Integrator>(Integrator) {
    if constexpr (Integrator::order > 2 || std::is_same_v<Integrator, integrators::RungeKutta<integrators::Heun>>) {
      double viscous = 0;
      const auto residual = [&](int steps) {
        auto flow = make_wave(DensityForm::evolved, 2);
        const double before = flow.energies().total();
        test::run_steps<Integrator>(flow, steps, final_time / steps);
        viscous = flow.energies().ledger.viscous;
        return std::abs(flow.energies().total() - before);
      };
      const double coarse = residual(coarse_steps<Integrator>), fine = residual(2 * coarse_steps<Integrator>);
      std::printf("    %s: residual %.2g and %.2g J of %.2g J booked, order %.2f\n", Integrator::info.name.data(),
                  coarse, fine, viscous, std::log2(coarse / fine));
      EXPECT_GT(viscous, 1e-4);
      EXPECT_LE(fine, std::max(coarse * std::pow(2, 0.3 - Integrator::order), 1e-13 * viscous))
          << Integrator::info.name;
    }
  });
}

// Criterion: steps by the error, from the longest that the limits allow, end within 20 times the tolerance, and a
// smaller tolerance ends nearer.
TEST(Order, EmbeddedPairsMeetTheirTolerance) {
  const test::Threads one(1);
  const auto exact = state_after<integrators::RungeKutta<integrators::Classical>>(DensityForm::evolved, 2048);
  const auto check = [&]<class Pair>(Pair) {
    double before = 1;
    for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
      auto flow = make_wave(DensityForm::evolved);
      flow.step_control().tolerance = tolerance;
      int steps = 0;
      while (flow.time() < final_time * (1 - 1e-12)) {
        const double proposed = flow.step_control().proposed, limit = flow.stable_step({.courant = 2}).dt;
        Pair::step(flow, std::min({proposed > 0 ? proposed : limit, limit, final_time - flow.time()}));
        ++steps;
      }
      const double error = distance(state_of(flow), exact);
      std::printf("    %s, tolerance %.0e: error %.2g after %d steps, %ld repeated\n", Pair::info.name.data(),
                  tolerance, error, steps, flow.step_control().rejected);
      EXPECT_LE(error, 20 * tolerance) << Pair::info.name;
      EXPECT_LT(error, before) << Pair::info.name;
      before = error;
    }
  };
  check(integrators::EmbeddedPair<integrators::BogackiShampine>{});
  check(integrators::EmbeddedPair<integrators::DormandPrince>{});
}

// Criterion: a rejected step leaves state, accounts and time as they were: the next one gives the bits of a run that
// never tried. Leaving out the lists, which a trial may have rebuilt: positions, velocities and densities by id to
// 1e-14.
TEST(Order, ARejectedStepLeavesNoTrace) {
  const test::Threads one(1);
  using Pair = integrators::EmbeddedPair<integrators::BogackiShampine>;
  auto tried = make_wave(DensityForm::evolved, 2), straight = make_wave(DensityForm::evolved, 2);
  tried.step_control().tolerance = 1e-9;
  Pair::step(tried, 0.2);
  EXPECT_GT(tried.step_control().rejected, 0);
  Pair::step(straight, tried.time());
  EXPECT_NEAR(straight.time(), tried.time(), 1e-15);
  EXPECT_LE(distance(state_of(straight), state_of(tried)), 1e-14);
  EXPECT_NEAR(straight.energies().ledger.viscous, tried.energies().ledger.viscous,
              1e-12 * straight.energies().ledger.viscous);
}

// Criterion: a run with steps by the error that goes on from a copied store and memory takes the steps and ends with
// the bits of one that never stopped.
TEST(Order, StepsByTheErrorGoOnFromMemory) {
  const test::Threads one(1);
  using Pair = integrators::EmbeddedPair<integrators::BogackiShampine>;
  const auto advance = [](auto& flow, int steps) {
    flow.step_control().tolerance = 1e-7;
    for (int k = 0; k < steps; ++k) {
      const double proposed = flow.step_control().proposed;
      Pair::step(flow, proposed > 0 ? proposed : 0.01);
    }
  };
  auto whole = make_wave(DensityForm::evolved);
  advance(whole, 7);
  WeaklyCompressible<1> second(Store<1>(whole.store()), whole.domain(), whole.options(), whole.memory());
  advance(whole, 8);
  advance(second, 8);
  EXPECT_EQ(whole.time(), second.time());
  EXPECT_EQ(state_of(whole), state_of(second));
}

// Criterion: a run, its velocities turned, and the run back: the start again, to 1e-9 of the amplitudes.
TEST(Order, LeapfrogRunsBackwards) {
  const test::Threads one(1);
  for (const auto density : forms) {
    auto flow = make_wave(density);
    const auto start = state_of(flow);
    const int steps = 100;
    test::run_steps<integrators::Leapfrog>(flow, steps, final_time / steps);
    const double away = distance(state_of(flow), start);
    for (auto& u : flow.store().get<v>()) u = -u;
    test::run_steps<integrators::Leapfrog>(flow, steps, final_time / steps);
    for (auto& u : flow.store().get<v>()) u = -u;
    const double back = distance(state_of(flow), start);
    std::printf("    %s: %.2g away, %.2g after the way back\n", name_of(density), away, back);
    EXPECT_GT(away, 1e-3);
    EXPECT_LE(back, 1e-9 * away) << name_of(density);
  }
}

}  // namespace
}  // namespace undine
