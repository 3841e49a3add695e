#include <cstdio>

#include <gtest/gtest.h>

#include "undine/analysis/exact/riemann.hpp"
#include "unit/schemes/gas_flow.hpp"

// Sod's tube by the recommended scheme, between mirrors.

namespace undine {
namespace {

using namespace field;

/// Sod's tube of particles of one mass between mirrors, `dense` of them on the left.
struct Tube {
  explicit Tube(int dense) : spacing(0.5 / dense) {
    test::GasParticles<1> all;
    const auto add = [&](double at, double dp, double density, double pressure) {
      all.x.push_back({{at}});
      all.v.push_back({});
      all.m.push_back(density * dp);
      all.rho.push_back(density);
      all.e.push_back(pressure / (0.4 * density));
      all.h.push_back(q * dp);
    };
    for (int i = 0; i < dense; ++i) add(-0.5 + (i + 0.5) * spacing, spacing, 1, 1);
    for (int i = 0; i < dense / 8; ++i) add((i + 0.5) * 8 * spacing, 8 * spacing, 0.125, 0.1);
    store = test::gas_store(all, 0.0);
    options = test::gas<1>(q * spacing, spacing);
    options.kernels.fill(KernelChoice(Kernels::index_of("quintic_spline")));
    options.support.kappa = 3;
    options.artificial.emplace(terms::GasViscositySignal{});
    options.viscosity_switch.choose(terms::ViscositySwitches::index<terms::SwitchCullenDehnen>());
    options.conductivity.emplace();
    options.mirrored_support = 16 * q * spacing;
    const walls::Solid<1> left{.faces = {{.normal = {{1}}, .offset = -0.5}}, .name = "left"};
    const walls::Solid<1> right{.faces = {{.normal = {{-1}}, .offset = -0.5}}, .name = "right"};
    options.wall_density = walls::WallDensity::copied;
    options.mirrors = std::make_shared<walls::Mirrors<1>>(std::vector{left, right}, walls::Slip::free,
                                                          options.mirrored_support * 1.1, domain);
    options.ghost_hydrostatic = false;
  }

  static constexpr double q = 3.6;
  double spacing;
  Domain<1> domain{{{-0.8}}, {{0.8}}, {false}};
  Store<1> store;
  GasOptions<1> options;

  /// L1 error of the density at 0.2 s; `until` as soon as all went wrong.
  double error() {
    Gas<1> flow(Store<1>(store), domain, options);
    const StepLimits limits{.courant = 0.3};
    while (flow.time() < 0.2)
      integrators::Leapfrog::step(flow, std::min(flow.stable_step(limits).dt, 0.2 - flow.time() + 1e-12));
    const auto solution = exact::Riemann{}.at(flow.time());
    double sum = 0, volume = 0;
    const IndexRange fluid = flow.store().range(Group::fluid);
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
      const double part = flow.store().get<m>()[i] / flow.store().get<rho>()[i];
      const double wanted = solution({{flow.store().get<x>()[i][0]}})[0];
      sum += part * std::abs(flow.store().get<rho>()[i] - wanted);
      volume += part;
    }
    return sum / volume;
  }
};

// Criterion: L1 error of the density at most 1 % of the dense side's with 450 particles, and 0.6 times that or less
// with twice as many.
TEST(Gas, SodsTube) {
  const test::Threads one(1);
  const double coarse = Tube(400).error();
  EXPECT_LT(coarse, 0.01);
  const double half = Tube(200).error();
  std::printf("    L1 error of the density: %.5f with 225 particles, %.5f with 450\n", half, coarse);
  EXPECT_LT(coarse / half, 0.6);
}

// Criterion: while the shock runs the switch keeps alpha within its bounds, above 0.7 in the shock and below 0.1 in the
// gas at rest before it.
TEST(Gas, SwitchActsInTheShockAlone) {
  const test::Threads one(1);
  Tube tube(200);
  Gas<1> flow(Store<1>(tube.store), tube.domain, tube.options);
  const StepLimits limits{.courant = 0.3};
  while (flow.time() < 0.1) integrators::Leapfrog::step(flow, flow.stable_step(limits).dt);
  double in_shock = 0;
  const double shock = 1.7522 * flow.time();  // the speed of Sod's shock
  const IndexRange fluid = flow.store().range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const double alpha = flow.store().get<alpha_v>()[i], place = flow.store().get<x>()[i][0];
    EXPECT_GE(alpha, 0);
    EXPECT_LE(alpha, 2);
    if (place > 0.35) {
      EXPECT_LT(alpha, 0.1) << place;
    }
    if (std::abs(place - shock) < 0.03) in_shock = std::max(in_shock, alpha);
  }
  EXPECT_GT(in_shock, 0.7);
}

// Criterion: a run that goes on from its memory has the same bits as one that was not interrupted.
TEST(Gas, GoesOnWithTheSameBits) {
  const test::Threads one(1);
  Tube tube(80);
  Gas<1> whole(Store<1>(tube.store), tube.domain, tube.options);
  for (int k = 0; k < 40; ++k) integrators::Leapfrog::step(whole, 5e-4);
  Gas<1> second(Store<1>(whole.store()), tube.domain, tube.options, whole.memory());
  for (int k = 0; k < 40; ++k) {
    integrators::Leapfrog::step(whole, 5e-4);
    integrators::Leapfrog::step(second, 5e-4);
  }
  const IndexRange fluid = whole.store().range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    EXPECT_EQ(whole.store().get<x>()[i], second.store().get<x>()[i]);
    EXPECT_EQ(whole.store().get<e>()[i], second.store().get<e>()[i]);
    EXPECT_EQ(whole.store().get<alpha_v>()[i], second.store().get<alpha_v>()[i]);
  }
  EXPECT_EQ(whole.memory(), second.memory());
}

}  // namespace
}  // namespace undine
