#pragma once
#include <cmath>
#include <utility>

#include "undine/integrators/catalogue.hpp"
#include "undine/schemes/weakly_compressible.hpp"
#include "unit/engine/crowd.hpp"
#include "unit/under_sanitizer.hpp"

namespace undine::test {

/// A liquid of Tait's law with a speed of sound of 20 m/s, and all pair arithmetic in double.
template <int N>
WeaklyCompressibleOptions<N> liquid(double support) {
  WeaklyCompressibleOptions<N> options;
  options.support.uniform = support;
  options.materials = {
      {.name = "test", .rho_0 = 1000, .mu = 0, .eos = materials::TaitSoundSpeed{.rho_0 = 1000, .c_0 = 20, .gamma = 7}}};
  options.backend = {BackendKind::threads, PairPrecision::double_precision};
  return options;
}

/// A store with room for what a scheme needs at the start.
template <int N>
Store<N> empty_store() {
  using namespace field;
  Store<N> store;
  store.allocate(Fields<x, v, rho, h, m, rho_0, rho_wall, mu, x_list>::set());
  return store;
}

/// Appends particles at rest, at the reference density.
template <int N>
void add_particles(Store<N>& store, Group group, const std::vector<Vec<N>>& at, double spacing, double support) {
  using namespace field;
  const std::size_t first = store.append(group, at.size(), 0);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const std::size_t i = first + k;
    store.template get<x>()[i] = at[k];
    store.template get<rho>()[i] = store.template get<rho_0>()[i] = store.template get<rho_wall>()[i] = 1000;
    store.template get<h>()[i] = support;
    store.template get<m>()[i] = 1000 * std::pow(spacing, N);
  }
}

/// A periodic unit square of side x side disordered particles that move at random, at up to 1 m/s on each axis.
struct PeriodicSquare {
  int side = 20;
  double spacing = 1.0 / side;
  double support = 2.6 * spacing;

  Domain<2> domain() const { return {{{0, 0}}, {{1, 1}}, {true, true}}; }
  Store<2> store(std::uint64_t seed = 1) const {
    Random random(seed);
    std::vector<Vec<2>> at;
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j)
        at.push_back(Vec<2>{{(i + 0.5) * spacing, (j + 0.5) * spacing}} + random.vector<2>(0.2 * spacing));
    auto store = empty_store<2>();
    add_particles(store, Group::fluid, at, spacing, support);
    for (auto& u : store.get<field::v>()) u = random.vector<2>(1);
    for (auto& density : store.get<field::rho>()) density *= random.between(0.998, 1.002);
    return store;
  }
};

template <class Integrator, class Flow>
void run_steps(Flow& flow, int steps, double dt) {
  for (int k = 0; k < steps; ++k) Integrator::step(flow, dt);
}

template <class List, class Term>
OneOf<List> chosen() {
  OneOf<List> term;
  term.choose(List::template index<Term>());
  return term;
}

}  // namespace undine::test
