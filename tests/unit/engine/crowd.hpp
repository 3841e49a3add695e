#pragma once
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <omp.h>

#include "undine/engine/neighbours.hpp"
#include "undine/engine/store.hpp"

namespace undine::test {

/// The same random numbers on every machine (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// Uniform in [low, high).
  double between(double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; }
  template <int N>
  Vec<N> vector(double size) {
    Vec<N> a;
    for (int k = 0; k < N; ++k) a[k] = between(-size, size);
    return a;
  }
  std::vector<std::uint32_t> shuffled(std::size_t n) {
    std::vector<std::uint32_t> order(n);
    for (std::size_t k = 0; k < n; ++k) order[k] = static_cast<std::uint32_t>(k);
    for (std::size_t k = n; k > 1; --k) std::swap(order[k - 1], order[bits() % k]);
    return order;
  }

 private:
  std::uint64_t state_;
};

/// As many threads as asked for while it lives: more than one only slows small runs down.
class Threads {
 public:
  explicit Threads(int n) : before_(omp_get_max_threads()) { omp_set_num_threads(n); }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_;
};

/// A lattice of particles put out of order, the lowest layers along the last axis being wall, in a box that is periodic
/// or not.
struct CrowdOptions {
  int side = 16;          ///< particles along each axis
  double spacing = 0.01;  ///< m
  double disorder = 0.3;  ///< largest displacement, spacings
  double origin = 0;      ///< low corner of the box on every axis, spacings
  int wall_layers = 3;
  bool periodic = false;
  double support = 2.6;  ///< H, spacings; each particle's own h is within 20 % below it
};

template <int N>
struct Crowd {
  Store<N> store;
  Domain<N> domain;
  double support;
};

/// The particles have every field of fields.def: positive ones where physics divides by them, and values of either sign
/// elsewhere.
template <int N>
Crowd<N> make_crowd(const CrowdOptions& o, std::uint64_t seed = 1) {
  Random random(seed);
  std::vector<Vec<N>> fluid, wall;
  int count = 1;
  for (int k = 0; k < N; ++k) count *= o.side;
  for (int cell = 0; cell < count; ++cell) {
    Vec<N> at = random.vector<N>(o.disorder);
    int rest = cell, layer = 0;
    for (int k = 0; k < N; ++k, rest /= o.side) {
      layer = rest % o.side;
      at[k] = (at[k] + layer + 0.5 + o.origin) * o.spacing;
    }
    (layer < o.wall_layers ? wall : fluid).push_back(at);
  }

  Crowd<N> crowd{{}, Domain<N>::unbounded(), o.support * o.spacing};
  for (int k = 0; k < N; ++k) {
    crowd.domain.low[k] = o.origin * o.spacing;
    crowd.domain.high[k] = (o.origin + o.side) * o.spacing;
    crowd.domain.periodic[k] = o.periodic;
  }

  auto& store = crowd.store;
  FieldSet all;
  all.set();
  store.allocate(all);
  store.append(Group::fluid, fluid.size(), 0);
  store.append(Group::wall, wall.size(), 0);
  fluid.insert(fluid.end(), wall.begin(), wall.end());
  for (std::size_t i = 0; i < store.size(); ++i) {
    const auto near = [&](double middle, double share) { return middle * random.between(1 - share, 1 + share); };
    store.template get<field::x>()[i] = fluid[i];
    store.template get<field::v>()[i] = random.vector<N>(1);
    store.template get<field::rho>()[i] = near(1000, 0.05);
    store.template get<field::h>()[i] = random.between(0.8, 1) * crowd.support;
    store.template get<field::m>()[i] = near(1000, 0.1) * std::pow(o.spacing, N);
    store.template get<field::rho_0>()[i] = 1000;
    store.template get<field::mu>()[i] = near(1, 0.5);
    store.template get<field::p>()[i] = random.between(-1e4, 1e4);
    store.template get<field::c>()[i] = near(30, 0.1);
    store.template get<field::grad_rho_l>()[i] = random.vector<N>(1e3);
  }
  Random other(seed + 1);  // of its own, so that the crowd stays what it was before there was this field
  for (auto& u : store.template get<field::v_friction>()) u = other.vector<N>(1);
  Random gas(seed + 2);
  for (std::size_t i = 0; i < store.size(); ++i) {
    store.template get<field::acc>()[i] = gas.vector<N>(10);
    store.template get<field::e>()[i] = gas.between(1, 3);
    store.template get<field::omega>()[i] = gas.between(0.8, 1.2);
    store.template get<field::alpha_v>()[i] = gas.between(0.1, 1);
    store.template get<field::balsara>()[i] = gas.between(0, 1);
    auto& stress = store.template get<field::stress>()[i];
    for (int j = 0; j < N; ++j)
      for (int k = 0; k <= j; ++k) stress[j][k] = stress[k][j] = gas.between(-1, 1);
  }
  return crowd;
}

}  // namespace undine::test
