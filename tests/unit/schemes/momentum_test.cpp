#include <gtest/gtest.h>

#include "unit/schemes/flow.hpp"

// What the equations conserve is conserved by whole runs: integrator, list builds and periods included.

namespace undine {
namespace {

using namespace field;
using test::PeriodicSquare;

constexpr double dt = 2e-4;

/// |sum m v after - before| over sum m |v|.
double momentum_drift(WeaklyCompressible<2>& flow, int steps, auto integrator) {
  const auto momentum = [&] {
    Vec<2> sum;
    for (std::size_t i = 0; i < flow.store().size(); ++i) sum += flow.store().get<m>()[i] * flow.store().get<v>()[i];
    return sum;
  };
  double size = 0;
  for (std::size_t i = 0; i < flow.store().size(); ++i)
    size += flow.store().get<m>()[i] * norm(flow.store().get<v>()[i]);
  const Vec<2> before = momentum();
  test::run_steps<decltype(integrator)>(flow, steps, dt);
  return norm(momentum() - before) / size;
}

template <class Pressure, class Integrator>
double momentum_drift_of_square(DensityForm density, std::optional<OneOf<terms::ViscosityForms>> viscosity = {}) {
  const PeriodicSquare square;
  auto options = test::liquid<2>(square.support);
  options.pressure = test::chosen<terms::PressureForms, Pressure>();
  options.density = density;
  options.viscosity = viscosity;
  auto store = square.store();
  for (auto& value : store.get<mu>()) value = 1;
  WeaklyCompressible<2> flow(std::move(store), square.domain(), options);
  const double drift = momentum_drift(flow, test::fewer(50, 2), Integrator{});
  EXPECT_GT(flow.list_builds(), 1) << "the run should include list builds";
  return drift;
}

// Criterion: total momentum to 1e-12 of sum m |v| over 50 steps, for every integrator, density form and laminar
// viscosity that conserves it.
TEST(Momentum, IsConservedInAPeriodicBox) {
  const test::Threads one(1);
  integrators::Integrators::for_each([]<class Integrator>(Integrator) {
    for (const auto density : {DensityForm::evolved, DensityForm::summation, DensityForm::normalised}) {
      const double drift = momentum_drift_of_square<terms::PressureSymmetric, Integrator>(density);
      EXPECT_LE(drift, 1e-12) << Integrator::info.name << ' ' << static_cast<int>(density);
      std::printf("    %s, density form %d: %.2g\n", Integrator::info.name.data(), static_cast<int>(density), drift);
    }
  });
  using integrators::Leapfrog;
  EXPECT_LE((momentum_drift_of_square<terms::PressureSum, Leapfrog>(DensityForm::evolved)), 1e-12);
  EXPECT_LE((momentum_drift_of_square<terms::PressureMueller, Leapfrog>(DensityForm::evolved)), 1e-12);
  for (const auto& viscosity : {test::chosen<terms::ViscosityForms, terms::ViscosityMorris>(),
                                test::chosen<terms::ViscosityForms, terms::ViscosityMueller>()})
    EXPECT_LE((momentum_drift_of_square<terms::PressureSymmetric, Leapfrog>(DensityForm::evolved, viscosity)), 1e-12);
}

// Criterion: at least 1e-6 of sum m |v| for the forms that say they break it.
TEST(Momentum, IsBrokenByTheUnsymmetricForms) {
  const test::Threads one(1);
  using integrators::Leapfrog;
  const double plain = momentum_drift_of_square<terms::PressurePlain, Leapfrog>(DensityForm::evolved);
  const double by_difference = momentum_drift_of_square<terms::PressureDifference, Leapfrog>(DensityForm::evolved);
  std::printf("    plain %.2g, difference %.2g\n", plain, by_difference);
  EXPECT_GE(plain, 1e-6);
  EXPECT_GE(by_difference, 1e-6);
}

/// |sum m x cross v after - before| over sum m |x| |v| of a free disc that rotates, oscillates and is viscous.
template <class Pressure, class Integrator>
double spin_drift() {
  const double spacing = 0.05, support = 2.6 * spacing;
  test::Random random(3);
  std::vector<Vec<2>> at;
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j)
      if (i * i + j * j <= 100) at.push_back(spacing * Vec<2>{{1.0 * i, 1.0 * j}} + random.vector<2>(0.1 * spacing));
  auto store = test::empty_store<2>();
  test::add_particles(store, Group::fluid, at, spacing, support);
  for (std::size_t i = 0; i < store.size(); ++i) {
    const auto r = store.get<x>()[i];
    store.get<v>()[i] = Vec<2>{{-2 * r[1], 2 * r[0]}} + random.vector<2>(0.3);
  }
  auto options = test::liquid<2>(support);
  options.pressure = test::chosen<terms::PressureForms, Pressure>();
  options.artificial = terms::ViscosityMonaghan{.alpha = 0.1, .beta = 1};
  WeaklyCompressible<2> flow(std::move(store), Domain<2>::unbounded(), options);
  const auto spin = [&] {
    std::pair<double, double> sums{};
    for (std::size_t i = 0; i < flow.store().size(); ++i) {
      const auto& r = flow.store().get<x>()[i];
      const auto& u = flow.store().get<v>()[i];
      sums.first += flow.store().get<m>()[i] * (r[0] * u[1] - r[1] * u[0]);
      sums.second += flow.store().get<m>()[i] * norm(r) * norm(u);
    }
    return sums;
  };
  const auto [before, size] = spin();
  test::run_steps<Integrator>(flow, test::fewer(100, 2), 5e-4);
  return std::abs(spin().first - before) / size;
}

// Criterion: angular momentum to 1e-12 over 100 steps for the symmetric forms with leapfrog and predictor_corrector
// (euler moves x and v by rates of the same time, which adds dt^2 v cross acc a step); at least 1e-6 for the
// unsymmetric forms.
TEST(Momentum, AngularMomentumOfAFreeDiscIsConserved) {
  const test::Threads one(1);
  using integrators::Leapfrog;
  using integrators::PredictorCorrector;
  const double symmetric = spin_drift<terms::PressureSymmetric, Leapfrog>();
  const double sum = spin_drift<terms::PressureSum, Leapfrog>();
  const double corrected = spin_drift<terms::PressureSymmetric, PredictorCorrector>();
  const double euler = spin_drift<terms::PressureSymmetric, integrators::Euler>();
  const double plain = spin_drift<terms::PressurePlain, Leapfrog>();
  const double by_difference = spin_drift<terms::PressureDifference, Leapfrog>();
  std::printf("    symmetric %.2g, sum %.2g, predictor_corrector %.2g, euler %.2g; plain %.2g, difference %.2g\n",
              symmetric, sum, corrected, euler, plain, by_difference);
  EXPECT_LE(symmetric, 1e-12);
  EXPECT_LE(sum, 1e-12);
  EXPECT_LE(corrected, 1e-12);
  EXPECT_GE(euler, 1e-9);
  EXPECT_GE(plain, 1e-6);
  EXPECT_GE(by_difference, 1e-6);
}

}  // namespace
}  // namespace undine
