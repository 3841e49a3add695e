#include <gtest/gtest.h>

#include "unit/schemes/flow.hpp"

// Corrected gradients and shifted particles: what they reproduce exactly, what they conserve, and what they do to
// energy.

namespace undine {
namespace {

using namespace field;
using test::PeriodicSquare;

constexpr double spacing = 0.1, support = 0.3, c_0 = 20;

WeaklyCompressibleOptions<2> corrected_liquid() {
  auto options = test::liquid<2>(support);
  options.materials[0].eos = materials::Linear{.rho_0 = 1000, .c_0 = c_0};
  options.continuity = test::chosen<terms::ContinuityForms, terms::ContinuityVolume>();
  options.pressure = test::chosen<terms::PressureForms, terms::PressureDifference>();
  options.corrected_gradients = true;
  return options;
}

/// A block of side x side particles around the origin, off their lattice by up to `jitter` spacings.
Store<2> block(int side, double jitter) {
  test::Random random(7);
  std::vector<Vec<2>> at;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      at.push_back(spacing * Vec<2>{{i - 0.5 * (side - 1), j - 0.5 * (side - 1)}} + random.vector<2>(jitter * spacing));
  auto store = test::empty_store<2>();
  test::add_particles(store, Group::fluid, at, spacing, support);
  return store;
}

constexpr double A[2][2] = {{0.3, -1.2}, {0.7, 0.5}};  // dv_i/dx_j, 1/s
constexpr double rise = 5;                             // drho/dx, kg/m^4

/// A disordered block with v = A x and rho = 1000 + rise x.
Store<2> linear_block() {
  auto store = block(12, 0.2);
  for (std::size_t i = 0; i < store.size(); ++i) {
    const Vec<2> r = store.get<x>()[i];
    store.get<v>()[i] = {{A[0][0] * r[0] + A[0][1] * r[1], A[1][0] * r[0] + A[1][1] * r[1]}};
    store.get<rho>()[i] = 1000 + rise * r[0];
  }
  return store;
}

// Criterion: drho/dt = - rho div v to 1e-10 at every particle of a disordered block, at its edges and corners too,
// where plain gradients err by 5 % or more; likewise acc = - grad p/rho.
TEST(CorrectedGradients, AreExactForLinearFields) {
  WeaklyCompressible<2> flow(linear_block(), Domain<2>::unbounded(), corrected_liquid());
  auto plain_options = corrected_liquid();
  plain_options.corrected_gradients = false;
  WeaklyCompressible<2> plain(linear_block(), Domain<2>::unbounded(), plain_options);
  double worst_plain = 0;
  for (std::size_t i = 0; i < flow.store().size(); ++i) {
    const double density = flow.store().get<rho>()[i], divergence = A[0][0] + A[1][1];
    EXPECT_NEAR(flow.store().get<drho>()[i], -density * divergence, 1e-10 * density);
    EXPECT_NEAR(flow.store().get<acc>()[i][0], -sq(c_0) * rise / density, 1e-10 * sq(c_0) * rise / density);
    EXPECT_NEAR(flow.store().get<acc>()[i][1], 0, 1e-10 * sq(c_0) * rise / density);
    worst_plain = std::max(worst_plain, std::abs(plain.store().get<drho>()[i] / density + divergence));
  }
  EXPECT_GE(worst_plain, 0.05 * (A[0][0] + A[1][1]));
}

// Criterion: a particle that is shifted with s meets dv/dt = s.grad v and drho/dt = s.grad rho, exact for linear
// fields.
TEST(Shifting, CarriesVelocityAndDensityOfPlaces) {
  auto options = corrected_liquid();
  options.shifting = terms::ShiftingFickian{};
  WeaklyCompressible<2> flow(linear_block(), Domain<2>::unbounded(), options);
  double fastest = 0;
  for (std::size_t i = 0; i < flow.store().size(); ++i) {
    const Vec<2> s = flow.store().get<v_xsph>()[i];
    fastest = std::max(fastest, norm(s));
    const Vec<2> change = flow.store().get<acc>()[i] + Vec<2>{{sq(c_0) * rise / flow.store().get<rho>()[i], 0}};
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(change[k], A[k][0] * s[0] + A[k][1] * s[1], 1e-9);
    EXPECT_NEAR(flow.store().get<drho_diff>()[i], rise * s[0], 1e-9);
  }
  EXPECT_GE(fastest, 0.1);  // at the edges of the block, where particles are drawn out
}

// Criterion: s = - C c H grad C points out of the block at its right edge, by the plain sum over its neighbours.
TEST(Shifting, MovesTowardsEmptySpace) {
  auto options = corrected_liquid();
  options.shifting = terms::ShiftingFickian{.C = 0.5};
  WeaklyCompressible<2> flow(block(11, 0), Domain<2>::unbounded(), options);
  for (std::size_t i = 0; i < flow.store().size(); ++i) {
    const Vec<2> at = flow.store().get<x>()[i], s = flow.store().get<v_xsph>()[i];
    Vec<2> gradient;
    for (const Vec<2>& other : flow.store().get<x>()) {
      const Vec<2> d = at - other;
      const double R = norm(d) / support;
      if (R < 1)
        gradient += sq(spacing) * WendlandC2::alpha<2>() * WendlandC2::slope_over_R<2>(R) / std::pow(support, 4) * d;
    }
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(s[k], -0.5 * c_0 * support * gradient[k], 1e-9);
    if (at[0] > 0.49 && std::abs(at[1]) < 0.01) {
      EXPECT_GT(s[0], 1);
    }
  }
}

// Criterion: nu u'' to 1e-5 on a lattice, where the plain form with its 0.01 h^2 errs by more than 1 %; momentum to
// 1e-12 on disordered particles.
TEST(CorrectedGradients, MakeViscosityExactOnALattice) {
  constexpr double viscosity = 3;
  const auto acceleration = [](bool corrected) {
    auto store = block(17, 0);
    for (auto& value : store.get<mu>()) value = viscosity;
    for (std::size_t i = 0; i < store.size(); ++i) store.get<v>()[i] = {{sq(store.get<x>()[i][1]), 0}};
    auto options = corrected_liquid();
    options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
    options.corrected_gradients = corrected;
    WeaklyCompressible<2> flow(std::move(store), Domain<2>::unbounded(), options);
    for (std::size_t i = 0; i < flow.store().size(); ++i)
      if (norm(flow.store().get<x>()[i]) < 1e-6) return flow.store().get<acc>()[i][0];
    return 0.0;
  };
  const double exact = 2 * viscosity / 1000;
  EXPECT_NEAR(acceleration(true), exact, 1e-5 * exact);
  EXPECT_LT(acceleration(false), 0.99 * exact);
}

TEST(CorrectedGradients, LeaveViscosityItsMomentum) {
  const PeriodicSquare square;
  auto options = corrected_liquid();
  options.support.uniform = square.support;
  options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
  auto store = square.store();
  std::ranges::fill(store.get<rho>(), 1000.0);
  std::ranges::fill(store.get<mu>(), 1.0);
  WeaklyCompressible<2> flow(std::move(store), square.domain(), options);
  Vec<2> sum;
  double size = 0;
  for (std::size_t i = 0; i < flow.store().size(); ++i) {
    sum += flow.store().get<m>()[i] * flow.store().get<acc>()[i];
    size += flow.store().get<m>()[i] * norm(flow.store().get<acc>()[i]);
  }
  EXPECT_GT(size, 0);
  EXPECT_LE(norm(sum), 1e-12 * size);
}

/// The square at rest, disordered, shifted for a number of steps: RMS of s before and after.
std::pair<double, double> unevenness(double strength) {
  const PeriodicSquare square;
  auto options = corrected_liquid();
  options.support.uniform = square.support;
  options.shifting = terms::ShiftingFickian{.C = strength};
  auto store = square.store();
  std::ranges::fill(store.get<rho>(), 1000.0);
  std::ranges::fill(store.get<v>(), Vec<2>{});
  WeaklyCompressible<2> flow(std::move(store), square.domain(), options);
  const auto rms = [&] {
    double sum = 0;
    for (const Vec<2>& s : flow.store().get<v_xsph>()) sum += norm_sq(s);
    return std::sqrt(sum / static_cast<double>(flow.store().size()));
  };
  const double before = rms();
  test::run_steps<integrators::Leapfrog>(flow, 100, 0.4 * square.support / 2 / c_0);
  return {before, rms()};
}

// Criterion: 100 steps take the unevenness of disordered particles to a fifth or less.
TEST(Shifting, EvensOutParticles) {
  for (const double strength : {0.25, 0.5}) {
    const auto [before, after] = unevenness(strength);
    std::printf("    strength %g: %.3g -> %.3g\n", strength, before, after);
    EXPECT_LE(after, 0.2 * before);
  }
}

/// Residual of the audit over the kinetic energy at the start, for shifted particles in motion.
double audit_residual(int steps, double dt) {
  const PeriodicSquare square;
  auto options = corrected_liquid();
  options.support.uniform = square.support;
  options.shifting = terms::ShiftingFickian{};
  options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
  options.diffusion = test::chosen<terms::DiffusionForms, terms::DiffusionAntuono>();
  auto store = square.store();
  std::ranges::fill(store.get<rho>(), 1000.0);
  std::ranges::fill(store.get<mu>(), 10.0);
  for (std::size_t i = 0; i < store.size(); ++i) {
    const Vec<2> k = 2 * 3.14159265358979 * store.get<x>()[i];
    store.get<v>()[i] = {{-std::cos(k[0]) * std::sin(k[1]), std::sin(k[0]) * std::cos(k[1])}};
  }
  WeaklyCompressible<2> flow(std::move(store), square.domain(), options);
  const Energies start = flow.energies();
  test::run_steps<integrators::PredictorCorrector>(flow, steps, dt);
  const Energies end = flow.energies();
  EXPECT_NE(end.ledger.xsph, 0);
  return std::abs(end.total() - start.total()) / start.kinetic;
}

// Criterion: what shifting does to the energy is booked: the residual is one of time integration, falls with the step
// at first order or better, and is below 1e-3 with a Courant number of 0.2.
TEST(Shifting, IsBooked) {
  const double coarse = audit_residual(100, 6e-4), fine = audit_residual(200, 3e-4);
  std::printf("    residual over kinetic energy: %.2g, with half the step %.2g\n", coarse, fine);
  EXPECT_LE(fine, 1e-3);
  EXPECT_LE(fine, 0.6 * coarse);
}

}  // namespace
}  // namespace undine
