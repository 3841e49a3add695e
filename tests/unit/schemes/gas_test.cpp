#include <map>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "undine/core/error.hpp"
#include "unit/schemes/gas_flow.hpp"

namespace undine {
namespace {

using namespace field;

/// W and its gradient between two places with a support H, from the kernel's own functions.
template <int N>
struct OnePair {
  Vec<N> dx, grad;
  double w;

  OnePair(const Domain<N>& domain, KernelChoice kernel, const Vec<N>& a, const Vec<N>& b, double H)
      : dx(domain.nearest_image(a - b)) {
    const double R = norm(dx) / H;
    w = R < 1 ? kernel.w<N>(R) / std::pow(H, N) : 0;
    grad = dx * (R < 1 ? kernel.slope_over_R<N>(R) / std::pow(H, N + 2) : 0.0);
  }
};

// ---- Density and support --------------------------------------------------------------------------------------------

template <int N, class Sum>
void expect_density_and_support(int side, double q) {
  const double spacing = 1.0 / side;
  auto options = test::gas<N>(q * spacing, spacing);
  options.grad_h.choose(terms::GradHDensities::index<Sum>());
  if constexpr (std::is_same_v<Sum, terms::DensityGradHMass>) {
    options.pressure.choose(terms::GasPressureForms::index<terms::PressureGradHMass>());
    options.energy.choose(terms::EnergyForms::index<terms::EnergyGradHMass>());
  }
  const auto domain = test::unit_box<N>();
  const Gas<N> flow(test::gas_store(test::gas_box<N>(side, q * spacing, 3)), domain, options);
  const auto& store = flow.store();
  const auto at = store.template get<x>();
  const auto H = store.template get<h>(), mass = store.template get<m>();
  const auto sum_with = [&](std::size_t i, double support) {
    double sum = 0;
    for (std::size_t j = 0; j < store.size(); ++j)
      sum += (std::is_same_v<Sum, terms::DensityGradH> ? mass[i] : mass[j]) *
             OnePair<N>(domain, options.kernels[0], at[i], at[j], support).w;
    return sum;
  };
  for (std::size_t i = 0; i < store.size(); i += 7) {
    const double density = store.template get<rho>()[i];
    EXPECT_NEAR(density * std::pow(H[i] / q, N) / mass[i], 1, 1e-10);
    EXPECT_NEAR(density / sum_with(i, H[i]), 1, 1e-10);
    const double step = 1e-5 * H[i];
    const double slope = (sum_with(i, H[i] + step) - sum_with(i, H[i] - step)) / (2 * step);
    EXPECT_NEAR(store.template get<omega>()[i], 1 + H[i] / (N * density) * slope, 1e-6);
  }
}

// Criterion: rho H^N = m q^N and rho = the sum over all particles with the own H, to 1e-10; Omega as the sum's
// numerical derivative has it, to 1e-6.
TEST(Gas, DensityAndSupportBelongTogether) {
  const test::Threads one(1);
  expect_density_and_support<1, terms::DensityGradH>(60, 2.6);
  expect_density_and_support<2, terms::DensityGradH>(18, 2.6);
  expect_density_and_support<2, terms::DensityGradHMass>(18, 2.6);
  expect_density_and_support<3, terms::DensityGradHMass>(9, 2.2);
}

// Criterion: from an H that is ten times too small or three times too large the same one is found, to 1e-10.
TEST(Gas, SupportIsFoundFromAfar) {
  const test::Threads one(1);
  const double spacing = 0.05, q = 2.6;
  std::vector<double> found[3];
  for (const double factor : {1.0, 0.1, 3.0}) {
    auto all = test::gas_box<2>(20, q * spacing, 4);
    for (double& H : all.h) H = factor * q * spacing;
    const Gas<2> flow(test::gas_store(all), test::unit_box<2>(), test::gas<2>(q * spacing, spacing));
    auto& list = found[factor == 1 ? 0 : factor < 1 ? 1 : 2];
    list.resize(all.x.size());
    for (std::size_t i = 0; i < all.x.size(); ++i)
      list[static_cast<std::size_t>(flow.store().ids()[i])] = flow.store().get<h>()[i];
  }
  for (std::size_t i = 0; i < found[0].size(); ++i) {
    EXPECT_NEAR(found[1][i] / found[0][i], 1, 1e-10);
    EXPECT_NEAR(found[2][i] / found[0][i], 1, 1e-10);
  }
}

// ---- Pairs ----------------------------------------------------------------------------------------------------------

/// Acceleration and rate of energy by pressure, from all pairs, with the mean of both gradients or the mean support.
template <int N>
void expect_forces_of_all_pairs(std::uint64_t seed, double spread, Symmetrisation mean) {
  const int side = N == 1 ? 40 : N == 2 ? 14 : 7;
  const double spacing = 1.0 / side, support = 1.6 * spacing;
  auto options = test::gas<N>(support, spacing);
  test::take_symmetric_forms(options);
  options.support.mean = mean;
  auto all = test::gas_box<N>(side, support, seed);
  test::Random random(seed + 1);
  for (double& H : all.h) H = support * std::exp(random.between(-spread, spread));
  const auto domain = test::unit_box<N>();
  const Gas<N> flow(test::gas_store(all), domain, options);
  const auto& store = flow.store();
  const auto at = store.template get<x>(), u = store.template get<v>();
  const auto H = store.template get<h>(), mass = store.template get<m>(), density = store.template get<rho>(),
             pressure = store.template get<p>();
  for (std::size_t i = 0; i < store.size(); ++i) {
    Vec<N> a;
    double rate = 0, size = 1e-12;
    for (std::size_t j = 0; j < store.size(); ++j) {
      const auto gradient = [&](double support_of_pair) {
        return OnePair<N>(domain, options.kernels[0], at[i], at[j], support_of_pair).grad;
      };
      const Vec<N> grad = mean == Symmetrisation::gradients ? 0.5 * (gradient(H[i]) + gradient(H[j]))
                                                            : gradient(pair_support(mean, H[i], H[j]));
      const double both = mass[j] * (pressure[i] / sq(density[i]) + pressure[j] / sq(density[j]));
      a -= both * grad;
      rate += 0.5 * both * dot(u[i] - u[j], grad);
      size += both * norm(grad);
    }
    RC_ASSERT(norm(store.template get<acc>()[i] - a) < 1e-10 * size);
    RC_ASSERT(std::abs(store.template get<de>()[i] - rate) < 1e-10 * size);
  }
}

// Criterion: whatever the supports, every pair within the reach of its symmetrisation is met: forces as the sum over
// all pairs has them, to 1e-10.
RC_GTEST_PROP(Gas, ListsMissNoPairWhateverTheSupports, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const double spread = *rc::gen::element(0.0, 0.3, 0.7);
  const auto mean = *rc::gen::element(Symmetrisation::arithmetic, Symmetrisation::geometric, Symmetrisation::max,
                                      Symmetrisation::min, Symmetrisation::gradients);
  const test::Threads one(1);
  expect_forces_of_all_pairs<1>(seed, spread, mean);
  expect_forces_of_all_pairs<2>(seed, spread, mean);
}

// Criterion: the variational force is the numerical derivative of the internal energy at constant entropy by the
// particles' places, to 1e-5 of the largest force.
TEST(Gas, GradHForceIsTheSlopeOfTheEnergy) {
  const test::Threads one(1);
  const int side = 12;
  const double spacing = 1.0 / side, q = 2.6;
  for (const bool by_mass : {false, true}) {
    auto options = test::gas<2>(q * spacing, spacing);
    if (by_mass) {
      options.grad_h.choose(terms::GradHDensities::index<terms::DensityGradHMass>());
      options.pressure.choose(terms::GasPressureForms::index<terms::PressureGradHMass>());
      options.energy.choose(terms::EnergyForms::index<terms::EnergyGradHMass>());
    }
    const auto all = test::gas_box<2>(side, q * spacing, 8);
    const Gas<2> flow(test::gas_store(all), test::unit_box<2>(), options);
    std::vector<double> density(all.x.size());
    std::vector<Vec<2>> force(all.x.size());
    double largest = 0;
    for (std::size_t i = 0; i < all.x.size(); ++i) {
      const auto id = static_cast<std::size_t>(flow.store().ids()[i]);
      density[id] = flow.store().get<rho>()[i];
      force[id] = flow.store().get<m>()[i] * flow.store().get<acc>()[i];
      largest = std::max(largest, norm(force[id]));
    }
    // e = e_0 (rho/rho_0)^(gamma - 1) along an isentrope.
    const auto energy = [&](const test::GasParticles<2>& moved) {
      const Gas<2> other(test::gas_store(moved), test::unit_box<2>(), options);
      double sum = 0;
      for (std::size_t i = 0; i < moved.x.size(); ++i) {
        const auto id = static_cast<std::size_t>(other.store().ids()[i]);
        sum += moved.m[id] * all.e[id] * std::pow(other.store().get<rho>()[i] / density[id], test::adiabatic - 1);
      }
      return sum;
    };
    for (const std::size_t id : {5UL, 70UL, 101UL})
      for (int k = 0; k < 2; ++k) {
        const double step = 1e-4 * spacing;
        auto ahead = all, behind = all;
        ahead.x[id][k] += step;
        behind.x[id][k] -= step;
        EXPECT_NEAR(force[id][k], -(energy(ahead) - energy(behind)) / (2 * step), 1e-5 * largest) << by_mass;
      }
  }
}

// ---- Conservation ---------------------------------------------------------------------------------------------------

struct Totals {
  double power = 0, scale = 0;
  Vec<2> force;
};
Totals totals_of(const Gas<2>& flow) {
  Totals all;
  const auto& store = flow.store();
  for (std::size_t i = 0; i < store.size(); ++i) {
    const double mass = store.get<m>()[i], work = mass * dot(store.get<v>()[i], store.get<acc>()[i]);
    all.power += work + mass * store.get<de>()[i];
    all.scale += std::abs(work);
    all.force += mass * store.get<acc>()[i];
  }
  return all;
}

// Criterion: forces sum to zero and energy is only moved, to 1e-12 of the sum of all powers, for every pressure with
// its work, with and without viscosity, limiter, conductivity and stress.
TEST(Gas, KeepsEnergyAndMomentum) {
  const test::Threads one(1);
  const int side = 16;
  const double spacing = 1.0 / side, q = 2.6;
  for (int form = 0; form < terms::GasPressureForms::size; ++form)
    for (const int dissipation : {0, 1, 2}) {
      auto options = test::gas<2>(q * spacing, spacing);
      if (form == terms::GasPressureForms::index<terms::PressureGradHMass>()) {
        options.grad_h.choose(terms::GradHDensities::index<terms::DensityGradHMass>());
      } else if (form != terms::GasPressureForms::index<terms::PressureGradH>()) {
        test::take_symmetric_forms(options);
      }
      options.pressure.choose(form);
      options.energy.choose(terms::EnergyForms::index_of(options.pressure.info().name));
      if (dissipation > 0) {
        options.artificial.emplace(terms::GasViscositySignal{});
        options.conductivity.emplace();
        options.limiter = true;
      }
      if (dissipation == 2) {
        options.stress.emplace(terms::ViscousStressSymmetric{});
        options.artificial.emplace(terms::GasViscosityMonaghan{});
      }
      auto store = test::gas_store(test::gas_box<2>(side, q * spacing, 5));
      for (double& viscosity : store.get<mu>()) viscosity = 0.01;
      const Gas<2> flow(std::move(store), test::unit_box<2>(), options);
      const Totals all = totals_of(flow);
      EXPECT_LT(std::abs(all.power), 1e-12 * all.scale) << options.pressure.info().name << ", " << dissipation;
      EXPECT_LT(norm(all.force), 1e-12 * all.scale) << options.pressure.info().name << ", " << dissipation;
      EXPECT_GT(all.scale, 0.1);
    }
}

/// A smooth wave of finite amplitude on a periodic line.
Gas<1> make_wave(GasOptions<1> options, int particles) {
  test::GasParticles<1> all;
  const double k = 2 * std::numbers::pi, spacing = 1.0 / particles;
  for (int i = 0; i < particles; ++i) {
    const double at = (i + 0.5) * spacing;
    all.x.push_back({{at + 0.02 * std::sin(k * at)}});
    all.v.push_back({{0.1 * std::cos(k * at)}});
    all.rho.push_back(1 / (1 + 0.02 * k * std::cos(k * at)));
    all.m.push_back(spacing);
    all.e.push_back(2.5 * std::pow(all.rho.back(), 0.4));
    all.h.push_back(options.support.uniform / all.rho.back());
  }
  return Gas<1>(test::gas_store(all), test::unit_box<1>(), std::move(options));
}

template <class Integrator>
double drift_of(double dt) {
  auto options = test::gas<1>(2.6 / 50, 1.0 / 50);
  options.artificial.emplace(terms::GasViscositySignal{});
  auto flow = make_wave(options, 50);
  const double before = flow.energies().kinetic + flow.energies().elastic;
  const int steps = static_cast<int>(std::lround(0.2 / dt));
  for (int k = 0; k < steps; ++k) Integrator::step(flow, dt);
  return std::abs(flow.energies().kinetic + flow.energies().elastic - before) / before;
}

// Criterion: kinetic and internal energy together stay to 1e-11 with Runge-Kutta of fourth order and a small step; with
// leapfrog the drift falls with the square of the step, by 3 or more for half of it.
TEST(Gas, EnergyDriftsWithTheStepOnly) {
  const test::Threads one(1);
  EXPECT_LT(drift_of<integrators::RungeKutta<integrators::Classical>>(5e-4), 1e-11);
  const double coarse = drift_of<integrators::Leapfrog>(2e-3), fine = drift_of<integrators::Leapfrog>(1e-3);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(coarse / fine, 3);
}

// Criterion: what is booked as taken by viscosity and pressure is nothing, to 1e-12 of the energy, and the audit's
// residual is the drift.
TEST(Gas, AccountsHoldNothingThatOnlyMoved) {
  const test::Threads one(1);
  auto options = test::gas<1>(2.6 / 50, 1.0 / 50);
  options.artificial.emplace(terms::GasViscositySignal{});
  options.conductivity.emplace();
  auto flow = make_wave(options, 50);
  for (int k = 0; k < 50; ++k) integrators::Leapfrog::step(flow, 2e-3);
  const auto& ledger = flow.energies().ledger;
  for (const double account : {ledger.artificial, ledger.diffusion, ledger.exchange, ledger.walls, ledger.body})
    EXPECT_LT(std::abs(account), 1e-12 * flow.energies().elastic);
}

// ---- Walls ----------------------------------------------------------------------------------------------------------

// Criterion: the gas feels wall particles that hold a state as it feels gas in that state: acceleration and rate of
// energy of every particle to 1e-12 of the largest. After ten steps the walls have the densities, energies and places
// of the start, exactly.
TEST(Gas, WallsThatAnswerAreGasThatStays) {
  const test::Threads one(1);
  auto all = test::gas_box<1>(40, 2.6 / 40, 6);
  test::GasParticles<1> halves[2];
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    const bool wall = all.x[i][0] > 0.5;
    if (wall) all.v[i] = {};
    auto& half = halves[wall];
    half.x.push_back(all.x[i]), half.v.push_back(all.v[i]), half.m.push_back(all.m[i]);
    half.rho.push_back(all.rho[i]), half.e.push_back(all.e[i]), half.h.push_back(all.h[i]);
  }
  auto options = test::gas<1>(2.6 / 40, 1.0 / 40);
  test::take_symmetric_forms(options);
  options.artificial.emplace(terms::GasViscositySignal{});
  options.conductivity.emplace();
  const Gas<1> whole(test::gas_store(all), test::unit_box<1>(), options);
  options.wall_density = walls::WallDensity::held;
  auto store = test::gas_store(halves[0]);
  test::add_gas(store, Group::wall, halves[1]);
  Gas<1> flow(std::move(store), test::unit_box<1>(), options);

  const auto rates = [](const Gas<1>& of) {
    std::map<double, std::array<double, 2>> at;  // by place
    const IndexRange fluid = of.store().range(Group::fluid);
    for (std::size_t i = fluid.begin; i < fluid.end; ++i)
      at[of.store().get<x>()[i][0]] = {of.store().get<acc>()[i][0], of.store().get<de>()[i]};
    return at;
  };
  const auto expected = rates(whole);
  double largest[2] = {};
  for (const auto& [at, rate] : expected)
    for (const int k : {0, 1}) largest[k] = std::max(largest[k], std::abs(rate[k]));
  for (const auto& [at, rate] : rates(flow))
    for (const int k : {0, 1}) EXPECT_NEAR(rate[k], expected.at(at)[k], 1e-12 * largest[k]);

  const auto walls_of = [](const Gas<1>& of) {
    std::map<double, std::array<double, 2>> at;
    const IndexRange wall = of.store().range(Group::wall);
    for (std::size_t i = wall.begin; i < wall.end; ++i)
      at[of.store().get<x>()[i][0]] = {of.store().get<rho>()[i], of.store().get<e>()[i]};
    return at;
  };
  const auto before = walls_of(flow);
  for (int k = 0; k < 10; ++k) integrators::Leapfrog::step(flow, 1e-4);
  EXPECT_EQ(walls_of(flow), before);
  EXPECT_EQ(before.size(), halves[1].x.size());
}

// ---- Laws of H ------------------------------------------------------------------------------------------------------

// Criterion: with density by continuity, H by its rate (2.68) is H by density (2.67), to 1e-5 after 0.2 s; and both
// differ from the start by more than 1 %.
TEST(Gas, SupportByRateIsSupportByDensity) {
  const test::Threads one(1);
  std::vector<double> found[2];
  for (const auto law : {SmoothingLaw::density, SmoothingLaw::continuity}) {
    auto options = test::gas<1>(2.6 / 50, 1.0 / 50);
    test::take_symmetric_forms(options);
    options.smoothing = law;
    auto flow = [&] {
      auto wave = make_wave(options, 50);
      return Gas<1>(Store<1>(wave.store()), test::unit_box<1>(), options);
    }();
    // The reference of both laws is H at rest.
    for (std::size_t i = 0; i < flow.store().size(); ++i) {
      flow.store().get<h>()[i] = options.support.uniform / flow.store().get<rho>()[i];
      if (law == SmoothingLaw::density) flow.store().get<rho_0>()[i] = 1;
    }
    flow.evaluate();
    for (int k = 0; k < 200; ++k) integrators::Leapfrog::step(flow, 1e-3);
    auto& list = found[law == SmoothingLaw::density ? 0 : 1];
    list.resize(50);
    for (std::size_t i = 0; i < 50; ++i)
      list[static_cast<std::size_t>(flow.store().ids()[i])] = law == SmoothingLaw::density
                                                                  ? options.support.uniform / flow.store().get<rho>()[i]
                                                                  : flow.store().get<h>()[i];
  }
  double change = 0;
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_NEAR(found[1][i] / found[0][i], 1, 1e-5);
    change = std::max(change, std::abs(found[0][i] / (2.6 / 50) - 1));
  }
  EXPECT_GT(change, 0.01);
}

// Criterion: gas that expands faster than its energy lasts ends the run with an error that names particle, time and
// remedy.
TEST(Gas, NegativeEnergyIsNamed) {
  const test::Threads one(1);
  auto flow = make_wave(test::gas<1>(2.6 / 50, 1.0 / 50), 50);
  flow.store().get<e>()[7] = -1e-3;
  try {
    flow.evaluate();
    FAIL() << "no error";
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(fmt::format("internal energy of particle {}", flow.store().ids()[7])), std::string::npos)
        << text;
    EXPECT_NE(text.find("time.courant"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace undine
