#include <gtest/gtest.h>

#include "undine/engine/corrected_interpolation.hpp"
#include "unit/schemes/flow.hpp"

// Walls as a scheme sees them: forces of fluid and wall are opposite, answers carry linear fields, walls that move stay
// on their path, and the accounts of their work close.

namespace undine {
namespace {

using namespace field;
using integrators::Leapfrog;
using integrators::PredictorCorrector;
using test::Threads;
using walls::WallDensity;

constexpr int across = 16;
constexpr double spacing = 1.0 / across, support = 2.6 * spacing;

/// A closed box [0, 1]^2 full of liquid in disorder, with three layers of wall around.
struct Vessel {
  WeaklyCompressibleOptions<2> options = test::liquid<2>(support);
  Store<2> store = test::empty_store<2>();
  Domain<2> domain{{{-2, -2}}, {{3, 3}}, {false, false}};

  explicit Vessel(double disorder = 0.1) {
    std::vector<Vec<2>> fluid, wall;
    test::Random random(3);
    for (int i = -3; i < across + 3; ++i)
      for (int j = -3; j < across + 3; ++j) {
        const Vec<2> at{{(i + 0.5) * spacing, (j + 0.5) * spacing}};
        const bool inside = i >= 0 && i < across && j >= 0 && j < across;
        if (inside)
          fluid.push_back(at + random.vector<2>(disorder * spacing));
        else
          wall.push_back(at);
      }
    test::add_particles(store, Group::fluid, fluid, spacing, support);
    test::add_particles(store, Group::wall, wall, spacing, support);
    for (auto& viscosity : store.get<mu>()) viscosity = 2;
    for (std::size_t i = store.range(Group::wall).begin; i < store.size(); ++i) store.get<rho_wall>()[i] = 800;
    options.walls.first_id = static_cast<std::int64_t>(fluid.size());
    for (const auto& at : wall) {
      Vec<2> to_mirror;
      for (int k = 0; k < 2; ++k) to_mirror[k] = at[k] < 0 ? -2 * at[k] : at[k] > 1 ? 2 * (1 - at[k]) : 0;
      options.walls.to_mirror.push_back(to_mirror);
      options.walls.start.push_back(at);
      options.walls.motion.push_back(-1);
    }
  }
  /// The wall left of the fluid follows `motion`.
  void move_left_wall(WallMotion<2> motion) {
    options.walls.motions = {std::move(motion)};
    for (std::size_t k = 0; k < options.walls.start.size(); ++k)
      if (options.walls.start[k][0] < 0) options.walls.motion[k] = 0;
  }
  void stir() {
    test::Random random(4);
    const IndexRange fluid = store.range(Group::fluid);
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) store.get<v>()[i] = random.vector<2>(1);
  }
  WeaklyCompressible<2> flow() { return WeaklyCompressible<2>(Store<2>(store), domain, options); }
};

WallMotion<2> shaking() {
  WallMotion<2> motion;
  motion.rigid = [](double t) {
    const double w = 20, size = 0.02;
    return WallMotion<2>::State{
        {{size * (1 - std::cos(w * t)), 0}}, {{size * w * std::sin(w * t), 0}}, {{size * w * w * std::cos(w * t), 0}}};
  };
  return motion;
}

/// Calls f(options change, name) for each way in which particles of walls act on fluid.
template <class F>
void for_each_answer(F f) {
  f("none but repulsion", [](auto& o) { o.repulsion = terms::Repulsion{.D = 20, .r_0 = spacing}; });
  for (const auto& [name, density] : {std::pair{"evolved", WallDensity::evolved},
                                      {"modified", WallDensity::modified},
                                      {"extrapolated", WallDensity::extrapolated},
                                      {"mirrored", WallDensity::mirrored}}) {
    f(name, [density = density](auto& o) { o.wall_density = density; });
    const bool can_hold = density == WallDensity::extrapolated || density == WallDensity::mirrored;
    if (can_hold)
      f((std::string(name) + ", no slip").c_str(), [density = density](auto& o) {
        o.wall_density = density;
        o.wall_no_slip = true;
      });
  }
}

// Criterion: sum m acc over fluid and walls vanishes to 1e-12 of its parts, with pressure, both viscosities and no
// slip.
TEST(Walls, GetTheMomentumThatTheFluidLoses) {
  const Threads one(1);
  for_each_answer([](const std::string& name, auto change) {
    Vessel vessel;
    vessel.stir();
    vessel.options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
    vessel.options.artificial = terms::ViscosityMonaghan{.alpha = 0.1};
    change(vessel.options);
    vessel.move_left_wall(shaking());
    auto flow = vessel.flow();
    test::run_steps<Leapfrog>(flow, 5, 1e-3);
    flow.evaluate();  // a step ends with forces that saw the predicted velocity
    flow.evaluate_wall_forces();
    Vec<2> sum{}, on_walls{};
    double size = 0;
    for (std::size_t i = 0; i < flow.store().size(); ++i) {
      const Vec<2> force = flow.store().get<m>()[i] * flow.store().get<acc>()[i];
      sum += force;
      size += norm(force);
      if (i >= flow.store().range(Group::wall).begin) on_walls += force;
    }
    EXPECT_LE(norm(sum), 1e-12 * size) << name;
    EXPECT_GT(norm(on_walls), 0) << name;
  });
}

// Criterion: with walls that move, the residual of the audit at 0.1 s is at most 1e-4 of the energy in play and falls
// by 2.5 or more with half the step; walls have done work.
TEST(Walls, WorkOfMovingWallsIsBooked) {
  const Threads one(1);
  for_each_answer([]<class Change>(const std::string& name, Change change) {
    const auto residual = [&]<class Integrator>(Integrator, int steps) {
      Vessel vessel(0);
      vessel.options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
      change(vessel.options);
      vessel.options.wall_pulls = true;  // without the kink of walls that never pull
      vessel.move_left_wall(shaking());
      auto flow = vessel.flow();
      const double start = flow.energies().total();
      test::run_steps<Integrator>(flow, test::fewer(steps), 0.1 / steps);
      const auto end = flow.energies();
      EXPECT_NE(end.ledger.walls, 0) << name;
      const double moved = std::abs(end.ledger.walls) + end.kinetic + std::abs(end.elastic);
      std::printf("    %s, %s, %d steps: residual %.3g of %.4g J\n", name.c_str(), Integrator::info.name.data(), steps,
                  (end.total() - start) / moved, moved);
      return std::abs(end.total() - start) / moved;
    };
    const auto check = [&](auto integrator) {
      const double coarse = residual(integrator, 200), fine = residual(integrator, 400);
      if (test::under_sanitizer) return;
      EXPECT_LE(fine, 1e-4) << name;
      EXPECT_GE(coarse / fine, 2.5) << name;
    };
    check(Leapfrog{});
    check(PredictorCorrector{});
  });
}

// Criterion: wall particles are at start + displacement(t) to the bit after any number of steps, with its velocity and
// that of the sliding surface, with every integrator.
TEST(Walls, MoveAsTheirFunctionOfTimeSays) {
  const Threads one(1);
  integrators::Integrators::for_each([]<class Integrator>(Integrator) {
    Vessel vessel(0);
    vessel.options.wall_density = WallDensity::extrapolated;
    auto motion = shaking();
    motion.slide = [](const Vec<2>& at, double t) { return Vec<2>{{0, at[1] + t}}; };
    vessel.move_left_wall(motion);
    auto flow = vessel.flow();
    test::run_steps<Integrator>(flow, 80, 1e-3);
    const auto& plan = vessel.options.walls;
    const auto state = motion.rigid(flow.time());
    EXPECT_GT(norm(state.displacement), 0.01);
    int moved = 0;
    for (std::size_t i = flow.store().range(Group::wall).begin; i < flow.store().size(); ++i) {
      const auto k = static_cast<std::size_t>(flow.store().ids()[i] - plan.first_id);
      const Vec<2> expected = plan.motion[k] < 0 ? plan.start[k] : plan.start[k] + state.displacement;
      const Vec<2> speed = plan.motion[k] < 0 ? Vec<2>{} : state.velocity + motion.slide(expected, flow.time());
      for (int axis = 0; axis < 2; ++axis) {
        EXPECT_EQ(flow.store().get<x>()[i][axis], expected[axis]);
        EXPECT_EQ(flow.store().get<v>()[i][axis], speed[axis]);
      }
      moved += plan.motion[k] >= 0;
    }
    EXPECT_GT(moved, 0);
    EXPECT_GE(flow.list_builds(), 2) << "lists must notice that walls move";
  });
}

// Criterion: a run resumed from its memory has the bits of one that never stopped, with moving walls of every kind.
TEST(Walls, ResumeWithTheSameBits) {
  const Threads one(1);
  for_each_answer([](const std::string& name, auto change) {
    Vessel vessel;
    vessel.stir();
    vessel.options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
    change(vessel.options);
    vessel.options.pushed_out = [](Vec<2> at) {
      at[1] = std::max(at[1], 0.02);
      return at;
    };
    vessel.move_left_wall(shaking());
    auto whole = vessel.flow();
    test::run_steps<Leapfrog>(whole, 13, 1e-3);
    WeaklyCompressible<2> second(Store<2>(whole.store()), vessel.domain, vessel.options, whole.memory());
    test::run_steps<Leapfrog>(whole, 12, 1e-3);
    test::run_steps<Leapfrog>(second, 12, 1e-3);
    for (const int f : {FieldId::x, FieldId::v, FieldId::rho, FieldId::p})
      EXPECT_TRUE(std::ranges::equal(whole.store().raw(f), second.store().raw(f))) << name << ' ' << f;
    EXPECT_EQ(whole.memory(), second.memory()) << name;
  });
}

// Criterion: density and velocity that are linear in x are found to 1e-10 of their size inside a disordered fluid, at
// its side and in its corner, where the first layer of wall has its mirror images; a lone particle gives its own values
// and no gradient; nothing gives weight 0.
TEST(Walls, CorrectedInterpolationIsExactForLinearFields) {
  Vessel vessel(0.3);
  auto& store = vessel.store;
  const auto linear = [](const Vec<2>& at) { return 1000 + 30 * at[0] - 50 * at[1]; };
  for (std::size_t i = 0; i < store.range(Group::fluid).end; ++i) {
    const Vec<2> at = store.get<x>()[i];
    store.get<rho>()[i] = linear(at);
    store.get<v>()[i] = {{at[1], 2 - at[0]}};
  }
  Neighbours<2> neighbours(vessel.domain, {});
  neighbours.build(store, support);
  const InterpolationSource<2> source{store, neighbours, vessel.domain, {}, Support{.uniform = support}};
  for (const Vec<2> at :
       {Vec<2>{{0.5, 0.5}}, Vec<2>{{0.01, 0.3}}, Vec<2>{{0.5 * spacing, 0.5 * spacing}}, Vec<2>{{0.97, 1.0}}}) {
    const auto fluid = interpolate_corrected(source, at);
    EXPECT_NEAR(fluid.rho, linear(at), 1e-7);
    EXPECT_NEAR(fluid.grad_rho[0], 30, 1e-7);
    EXPECT_NEAR(fluid.grad_rho[1], -50, 1e-7);
    EXPECT_NEAR(fluid.v[0], at[1], 1e-10);
    EXPECT_NEAR(fluid.v[1], 2 - at[0], 1e-10);
  }
  EXPECT_EQ(interpolate_corrected(source, Vec<2>{{2, 2}}).weight, 0);

  Vessel lone;
  std::vector<char> others(lone.store.size(), 1);
  others[0] = 0;
  lone.store.remove(others);
  lone.store.get<rho>()[0] = 1234;
  Neighbours<2> few(lone.domain, {});
  few.build(lone.store, support);
  const InterpolationSource<2> thin{lone.store, few, lone.domain, {}, Support{.uniform = support}};
  const auto beside = interpolate_corrected(thin, lone.store.get<x>()[0] + Vec<2>{{0.5 * support, 0}});
  EXPECT_GT(beside.weight, 0);
  EXPECT_NEAR(beside.rho, 1234, 1e-9);
  EXPECT_EQ(norm(beside.grad_rho), 0);
}

// Criterion: next to a still wall and a linear shear, friction takes the shear continued behind the surface (mdbc, to
// 1e-9), or at least half of it and against the flow (Adami, whose mean lies nearer to the wall or further than the
// mirror image).
TEST(Walls, NoSlipContinuesAShear) {
  for (const auto density : {WallDensity::mirrored, WallDensity::extrapolated}) {
    Vessel vessel(0);
    const IndexRange fluid = vessel.store.range(Group::fluid);
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) vessel.store.get<v>()[i] = {{vessel.store.get<x>()[i][1], 0}};
    vessel.options.wall_density = density;
    vessel.options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
    vessel.options.wall_no_slip = true;
    auto flow = vessel.flow();
    int seen = 0;
    for (std::size_t i = flow.store().range(Group::wall).begin; i < flow.store().size(); ++i) {
      const Vec<2> at = flow.store().get<x>()[i], taken = flow.store().get<v_friction>()[i];
      if (at[1] > 0 || at[1] < -spacing || at[0] < 2 * support || at[0] > 1 - 2 * support) continue;
      ++seen;
      if (density == WallDensity::mirrored)
        EXPECT_NEAR(taken[0], at[1], 1e-9);
      else
        EXPECT_LT(taken[0], 0.5 * at[1]);
      EXPECT_NEAR(taken[1], 0, 1e-12);
    }
    EXPECT_GT(seen, 0);
  }
}

// Criterion: fluid at rest and a wall accelerated by a give the pressures of a still wall in gravity -a, to 1e-9.
TEST(Walls, AnAcceleratedWallFeelsItsInertia) {
  Vessel still(0), shaken(0);
  for (auto* vessel : {&still, &shaken}) vessel->options.wall_density = WallDensity::extrapolated;
  for (auto* vessel : {&still, &shaken}) vessel->options.wall_pulls = true;
  still.options.gravity = {{-8, 0}};
  shaken.move_left_wall(shaking());  // a = (8, 0) m/s^2 at t = 0
  const auto a = still.flow(), b = shaken.flow();
  int seen = 0;
  for (std::size_t i = a.store().range(Group::wall).begin; i < a.store().size(); ++i) {
    const auto k = static_cast<std::size_t>(a.store().ids()[i] - still.options.walls.first_id);
    ASSERT_EQ(a.store().ids()[i], b.store().ids()[i]);
    if (shaken.options.walls.motion[k] < 0) continue;
    ++seen;
    EXPECT_NEAR(a.store().get<p>()[i], b.store().get<p>()[i], 1e-9 * 8000);
  }
  EXPECT_GT(seen, 0);
}

// Criterion: the repulsion of one wall particle is D ((r_0/r)^p1 - (r_0/r)^p2)/r away from it, to 1e-12, for the
// exponents of all sources, and zero from r_0 on; it is what the flow's acceleration holds.
TEST(Walls, RepelAsTheFormulaSays) {
  for (const auto& [p1, p2] : {std::pair{12.0, 6.0}, {4.0, 2.0}, {9.5, 4.0}})
    for (const double r : {0.4, 0.7, 0.99, 1.01, 1.5}) {
      Vessel vessel;
      vessel.store = test::empty_store<2>();
      test::add_particles(vessel.store, Group::fluid, {Vec<2>{{0.6 * r * spacing, 0.8 * r * spacing}}}, spacing,
                          support);
      test::add_particles(vessel.store, Group::wall, {Vec<2>{}}, spacing, support);
      vessel.options.repulsion = terms::Repulsion{.D = 3, .r_0 = spacing, .p1 = p1, .p2 = p2};
      const auto flow = vessel.flow();
      const Vec<2> a = flow.store().get<acc>()[0];
      const double expected = r < 1 ? 3 * (std::pow(1 / r, p1) - std::pow(1 / r, p2)) / (r * spacing) : 0;
      EXPECT_NEAR(a[0], 0.6 * expected, 1e-12 * expected) << p1 << ' ' << r;
      EXPECT_NEAR(a[1], 0.8 * expected, 1e-12 * expected) << p1 << ' ' << r;
      EXPECT_EQ(flow.store().get<drho>()[0], 0) << "repelling particles take no part in density";
    }
}

// Criterion: a particle at depth r < l leaves the step with (l - r)/dt more speed, and the account has the kinetic
// energy.
TEST(Walls, TheDistanceFunctionActsOnceAStep) {
  Vessel vessel;
  vessel.store = test::empty_store<2>();
  test::add_particles(vessel.store, Group::fluid, {Vec<2>{{0, 0.3}}, Vec<2>{{0, 2}}}, spacing, support);
  vessel.options.pushed_out = [](Vec<2> at) {
    at[1] = std::max(at[1], 0.5);
    return at;
  };
  const double dt = 0.01;
  integrators::Integrators::for_each([&]<class Integrator>(Integrator) {
    auto once = vessel.flow();
    Integrator::step(once, dt);
    EXPECT_NEAR(once.store().get<v>()[0][1], 0.2 / dt, 1e-12 / dt) << Integrator::info.name;
    EXPECT_EQ(once.store().get<v>()[1][1], 0);
    const auto e = once.energies();
    EXPECT_NEAR(e.total(), vessel.flow().energies().total(), 1e-9 * e.kinetic) << Integrator::info.name;
    EXPECT_NEAR(e.ledger.walls, -e.kinetic, 1e-12 * e.kinetic);
  });
}

// Criterion: a normalised sum goes with every answer, also with those that come from the fluid's density: in a full
// vessel at rest it is that of the lattice, to 2 % (whose kernel sum is 1 % off), also after 20 steps, but where walls
// only repel (nothing completes the sums at them) or are of modified density (which draw it to theirs): to a half.
TEST(Walls, OfEveryKindGoWithANormalisedDensity) {
  const Threads one(1);
  for_each_answer([](const std::string& name, auto change) {
    Vessel vessel(0);
    vessel.options.density = DensityForm::normalised;
    vessel.options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
    change(vessel.options);
    for (std::size_t i = vessel.store.range(Group::wall).begin; i < vessel.store.size(); ++i)
      vessel.store.get<rho_wall>()[i] = 500;  // about what a flat wall lacks
    auto flow = vessel.flow();
    const bool draws = name == "modified" || name == "none but repulsion";
    const auto worst = [&] {
      double most = 0;
      const IndexRange fluid = flow.store().range(Group::fluid);
      for (std::size_t i = fluid.begin; i < fluid.end; ++i)
        most = std::max(most, std::abs(flow.store().template get<rho>()[i] / 1000 - 1));
      return most;
    };
    EXPECT_LE(worst(), draws ? 0.5 : 0.02) << name;
    test::run_steps<Leapfrog>(flow, 20, 1e-3);
    EXPECT_LE(worst(), draws ? 0.5 : 0.02) << name;
  });
}

}  // namespace
}  // namespace undine
