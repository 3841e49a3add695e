#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "unit/schemes/flow.hpp"

// The energy audit of whole runs, and that runs repeat to the bit: for any number of threads, and when they go on from a stored state.

namespace undine {
namespace {

using namespace field;
using integrators::Leapfrog;
using integrators::PredictorCorrector;
using test::Threads;

/// Mirrors at the sides of the box [0, 1] x [0, 1].
Bounce<2> in_the_box(const Vec<2>&, const Vec<2>& to, const Vec<2>& velocity) {
  Bounce<2> bounce{to, velocity};
  for (int k = 0; k < 2; ++k) {
    if (to[k] < 0) bounce.x[k] = -to[k];
    if (to[k] > 1) bounce.x[k] = 2 - to[k];
    if (bounce.x[k] != to[k]) bounce.v[k] = -velocity[k];
  }
  return bounce;
}

/// A tank of 1 m x 1 m, half filled, with a heap on one side: it sloshes. Walls answer a modified density and reflect (`combined`).
struct Tank {
  int across = 20;
  double spacing = 1.0 / across;
  double support = 2.6 * spacing;

  Domain<2> domain() const { return {{{-1, -1}}, {{2, 2}}, {false, false}}; }
  WeaklyCompressibleOptions<2> options() const {
    auto options = test::liquid<2>(support);
    options.gravity = {{0, -9.81}};
    options.wall_density = walls::Combined::density;
    options.reflector = in_the_box;
    return options;
  }
  Store<2> store() const {
    std::vector<Vec<2>> fluid, wall;
    for (int i = -3; i < across + 3; ++i)
      for (int j = -3; j < across + 3; ++j) {
        const Vec<2> at{{(i + 0.5) * spacing, (j + 0.5) * spacing}};
        const bool inside = i >= 0 && i < across && j >= 0 && j < across;
        if (!inside)
          wall.push_back(at);
        else if (j < across / 2 + (i < across / 3 ? 4 : -2))
          fluid.push_back(at);
      }
    auto store = test::empty_store<2>();
    test::add_particles(store, Group::fluid, fluid, spacing, support);
    test::add_particles(store, Group::wall, wall, spacing, support);
    for (std::size_t i = store.range(Group::wall).begin; i < store.size(); ++i) store.get<rho_wall>()[i] = 600;
    for (auto& value : store.get<mu>()) value = 2;
    return store;
  }
};

struct Audit {
  double start, residual, before;
  Energies end;
  long list_builds;
};

template <class Integrator>
Audit audit(WeaklyCompressible<2>& flow, double time, int steps) {
  const double start = flow.energies().total();
  test::run_steps<Integrator>(flow, steps, time / steps);
  const auto end = flow.energies();
  return {start, (end.total() - start) / start, 0, end, flow.list_builds()};
}

void print(const char* what, int steps, const Audit& a) {
  const auto& l = a.end.ledger;
  std::printf("    %s, %d steps: residual %.3g of %.4g J; viscous %.3g artificial %.3g diffusion %.3g exchange %.3g walls %.3g xsph %.3g "
              "body %.3g; %ld list builds\n",
              what, steps, a.residual, a.start, l.viscous, l.artificial, l.diffusion, l.exchange, l.walls, l.xsph, l.body, a.list_builds);
}

TEST(Explore, Tank) {
  const Threads one(1);
  const Tank tank;
  for (int variant = 0; variant < 6; ++variant)
    for (const int steps : {150, 300, 600}) {
      auto options = tank.options();
      if (variant == 1) options.artificial = terms::ViscosityMonaghan{.alpha = 0.1};
      if (variant == 2) options.viscosity = test::chosen<terms::ViscosityForms, terms::ViscosityMorris>();
      if (variant == 3) options.diffusion = test::chosen<terms::DiffusionForms, terms::DiffusionFourtakas>();
      if (variant == 4) options.xsph = terms::Xsph{};
      if (variant == 5) {
        options.body_force = [](const Vec<2>& x, double t) { return Vec<2>{{5 * std::sin(20 * t) - x[0], 0}}; };
      }
      WeaklyCompressible<2> flow(tank.store(), tank.domain(), options);
      flow.set_potential_origin({{0, 0}});
      const std::string what = "variant " + std::to_string(variant);
      print(what.c_str(), steps, audit<Leapfrog>(flow, 0.15, steps));
      WeaklyCompressible<2> other(tank.store(), tank.domain(), options);
      print((what + " pc").c_str(), steps, audit<PredictorCorrector>(other, 0.15, steps));
    }
}

}  // namespace
}  // namespace undine
