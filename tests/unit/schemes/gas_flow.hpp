#pragma once
#include <cmath>
#include <utility>
#include <vector>

#include "undine/integrators/catalogue.hpp"
#include "undine/schemes/gas.hpp"
#include "unit/engine/crowd.hpp"

namespace undine::test {

constexpr double adiabatic = 1.4;

/// An ideal gas by grad-h sums without dissipation, and all pair arithmetic in double.
template <int N>
GasOptions<N> gas(double support, double spacing) {
  GasOptions<N> options;
  options.own_supports = true;
  options.smoothing = SmoothingLaw::number_density;
  options.support.uniform = support;
  options.support_over_spacing = support / spacing;
  options.materials = {{.name = "gas", .rho_0 = 1, .mu = 0, .eos = materials::IdealGas{.gamma = adiabatic}}};
  options.backend = {BackendKind::threads, PairPrecision::double_precision};
  return options;
}

/// The forms without grad-h sums, with H as it is given.
template <int N>
void take_symmetric_forms(GasOptions<N>& options) {
  options.density = DensityForm::evolved;
  options.smoothing = SmoothingLaw::constant;
  options.pressure.choose(terms::GasPressureForms::index<terms::PressureSymmetric>());
  options.energy.choose(terms::EnergyForms::index<terms::EnergySymmetric>());
}

template <int N>
struct GasParticles {
  std::vector<Vec<N>> x, v;
  std::vector<double> m, rho, e, h;
};

template <int N>
void add_gas(Store<N>& store, Group group, const GasParticles<N>& all, double alpha = 1) {
  using namespace field;
  const std::size_t first = store.append(group, all.x.size(), 0);
  for (std::size_t k = 0; k < all.x.size(); ++k) {
    const std::size_t i = first + k;
    store.template get<x>()[i] = all.x[k];
    store.template get<v>()[i] = all.v[k];
    store.template get<m>()[i] = all.m[k];
    store.template get<rho>()[i] = store.template get<rho_0>()[i] = all.rho[k];
    store.template get<e>()[i] = all.e[k];
    store.template get<h>()[i] = all.h[k];
    store.template get<alpha_v>()[i] = alpha;
  }
}

template <int N>
Store<N> gas_store(const GasParticles<N>& all, double alpha = 1) {
  using namespace field;
  Store<N> store;
  store.allocate(Fields<x, v, rho, e, h, m, rho_0, mu, alpha_v, x_list>::set());
  add_gas(store, Group::fluid, all, alpha);
  return store;
}

/// A periodic unit box of side^N disordered particles of unlike masses, energies and H, which move at random.
template <int N>
GasParticles<N> gas_box(int side, double support, std::uint64_t seed, double disorder = 0.3) {
  Random random(seed);
  GasParticles<N> all;
  const double spacing = 1.0 / side;
  std::size_t count = 1;
  for (int k = 0; k < N; ++k) count *= static_cast<std::size_t>(side);
  for (std::size_t cell = 0; cell < count; ++cell) {
    Vec<N> at = random.vector<N>(disorder * spacing);
    auto rest = static_cast<int>(cell);
    for (int k = 0; k < N; ++k, rest /= side) at[k] += (rest % side + 0.5) * spacing;
    all.x.push_back(at);
    all.v.push_back(random.vector<N>(0.5));
    all.rho.push_back(random.between(0.5, 1.5));
    all.m.push_back(all.rho.back() * std::pow(spacing, N));
    all.e.push_back(random.between(1, 3));
    all.h.push_back(support * random.between(0.7, 1.3));
  }
  return all;
}

template <int N>
Domain<N> unit_box() {
  Domain<N> domain{};
  for (int k = 0; k < N; ++k) {
    domain.low[k] = 0;
    domain.high[k] = 1;
    domain.periodic[k] = true;
  }
  return domain;
}

}  // namespace undine::test
