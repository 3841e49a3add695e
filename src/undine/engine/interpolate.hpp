#pragma once
#include <vector>

#include "undine/engine/neighbours.hpp"
#include "undine/engine/smoothing.hpp"
#include "undine/kernels/kernel.hpp"

namespace undine {

/// Fluid fields at a point, as particles near it say.
template <int N>
struct Interpolated {
  double weight = 0;      ///< Shepard sum of the fluid, sum V W: about 1 inside it, 1/2 at a flat surface, 0 in the air
  Vec<N> v{};             ///< m/s
  double p = 0, rho = 0;  ///< Pa, kg/m^3
};

/// The density by which a wall particle has its volume V = m/rho.
enum class WallVolume {
  at_rest,  ///< rho_0: of a liquid, where the density of a wall particle is an answer to the fluid, not a volume
  present   ///< rho: of a gas, which has no density at rest and whose wall particles have the state of gas
};

/// Where interpolation takes its values from; refers to the run, so it must not outlive it.
template <int N>
struct InterpolationSource {
  const Store<N>& store;            ///< fields x, m, rho, v and p; h if the support says so; rho_0 of a liquid's walls
  const Neighbours<N>& neighbours;  ///< built for this store, not stale
  const Domain<N>& domain;
  KernelChoice kernel;
  Support support;  ///< H of each particle: field h if `per_particle`, else `uniform`
  WallVolume wall_volume = WallVolume::at_rest;
};

/// Calls f(b, W_b) for each particle of a group with |x - x_b| < H_b (positions of now, nearest periodic image), by
/// ascending index; W_b = W(|x - x_b|, H_b) in 1/m^N.
template <int N, class F>
void for_each_near(const InterpolationSource<N>& source, Group group, const Vec<N>& x, F&& f) {
  std::vector<std::uint32_t> found;
  source.neighbours.near_point(x, group, source.store, found);
  const auto at = source.store.template get<field::x>();
  const auto support = source.store.template get<field::h>();
  source.kernel.visit([&](auto kernel) {
    for (const std::uint32_t b : found) {
      const double H = source.support.per_particle ? support[b] : source.support.uniform;
      const double R = norm(source.domain.nearest_image(x - at[b])) / H;
      if (!(R < 1)) continue;
      double W = kernel.template w<N>(R);
      for (int k = 0; k < N; ++k) W /= H;
      f(b, W);
    }
  });
}

/// f(x) = sum_b V_b f_b W_b / sum_b V_b W_b over the fluid, V = m/rho. All zero where no fluid is near. Shepard (1968).
template <int N>
Interpolated<N> interpolate(const InterpolationSource<N>& source, const Vec<N>& x) {
  const auto m = source.store.template get<field::m>();
  const auto rho = source.store.template get<field::rho>();
  const auto v = source.store.template get<field::v>();
  const auto p = source.store.template get<field::p>();
  Interpolated<N> sum;
  for_each_near(source, Group::fluid, x, [&](std::size_t b, double W) {
    const double VW = m[b] / rho[b] * W;
    sum.weight += VW;
    sum.v += VW * v[b];
    sum.p += VW * p[b];
    sum.rho += VW * rho[b];
  });
  if (!(sum.weight > 0)) return {};
  return {sum.weight, sum.v / sum.weight, sum.p / sum.weight, sum.rho / sum.weight};
}

/// sum_b V_b W_b over the fluid alone: how much of the kernel at x is filled by fluid. V = m/rho.
template <int N>
double fluid_share(const InterpolationSource<N>& source, const Vec<N>& x) {
  const auto m = source.store.template get<field::m>();
  const auto rho = source.store.template get<field::rho>();
  double sum = 0;
  for_each_near(source, Group::fluid, x, [&](std::size_t b, double W) { sum += m[b] / rho[b] * W; });
  return sum;
}

/// The same of the walls' particles.
template <int N>
double wall_share(const InterpolationSource<N>& source, const Vec<N>& x) {
  const auto m = source.store.template get<field::m>();
  const auto rho = source.wall_volume == WallVolume::at_rest ? source.store.template get<field::rho_0>()
                                                             : source.store.template get<field::rho>();
  double sum = 0;
  for_each_near(source, Group::wall, x, [&](std::size_t b, double W) { sum += m[b] / rho[b] * W; });
  return sum;
}

}  // namespace undine
