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

WeaklyCompressible<1> make_wave(DensityForm density) {
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
  }
  auto options = test::liquid<1>(support);
  options.density = density;
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

// Criterion: halving the step divides the error by 2^order, order within 0.2 of 1 for euler and of 2 for the others.
TEST(Order, IsWhatTheIntegratorsClaim) {
  const test::Threads one(1);
  for (const auto density : forms) {
    const auto exact = state_after<integrators::Leapfrog>(density, test::fewer(8192, 4));
    integrators::Integrators::for_each([&]<class Integrator>(Integrator) {
      constexpr bool first_order = std::is_same_v<Integrator, integrators::Euler>;
      const double coarse = distance(state_after<Integrator>(density, 128), exact);
      const double fine = distance(state_after<Integrator>(density, 256), exact);
      const double order = std::log2(coarse / fine);
      EXPECT_NEAR(order, first_order ? 1 : 2, 0.2) << Integrator::info.name << ", " << name_of(density);
      std::printf("    %s, %s: order %.3f (error %.2g)\n", Integrator::info.name.data(), name_of(density), order, fine);
    });
  }
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
