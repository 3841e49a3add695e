#pragma once
// Densities that are sums; included by flow.cpp alone.
#include "undine/engine/reproducing_interpolation.hpp"
#include "undine/schemes/flow.hpp"
#include "undine/schemes/particle_rules.hpp"

namespace undine {
namespace {

using namespace field;

}  // namespace

template <int N>
void Flow<N>::add_summation_stages(DensityForm form, bool walls) {
  const bool walls_answer = walls && !ghosts_;
  summation_.template use<0>().sources = {true, walls};
  fluid_summation_.template use<0>().sources = shepard_.template use<0>().sources = {true, walls && !walls_answer};
  if (form == DensityForm::summation) {
    add_sweep(summation_, walls);
    add_update("summed density", Group::fluid, rules::TakeSummedDensity{});
  }
  if (form != DensityForm::normalised) return;
  // Volumes in the Shepard sum are those of the plain sum: with the densities of before compression would never be
  // seen, as any uniform density reproduces itself. So they belong together and change rho in place. Walls complete the
  // plain sum, but the mean is over the fluid alone, as their density is an answer to the fluid's. Ghosts are fluid:
  // they follow in between, and take the new density afterwards.
  const Resources touched(Group::fluid, Fields<rho, rho_sum, w_sum>::set());
  Resources reads(Group::fluid, Fields<m, rho>::set() | place());
  if (walls) reads.add(Group::wall, Fields<m>::set() | place());
  plan_.add({"normalised density", reads, touched, [this, walls_answer] {
               run(summation_);
               update(store_, Group::fluid, rules::TakeSummedDensity{});
               if (ghosts_) ghosts_->mirror(store_, Fields<rho>::set());
               run(shepard_);
               if (walls_answer) run(fluid_summation_);
               update(store_, Group::fluid, rules::TakeNormalisedDensity{});
             }});
}

/// The density that particles carry, summed anew over the fluid alone: a wall's answer is nothing that was carried.
template <int N>
void Flow<N>::filter_density() {
  double every = 1;
  int order = 0;
  auto filter = *common_->density_filter;
  filter.with_chosen([&](const auto& chosen) {
    every = chosen.every;
    order = chosen.order;
  });
  if (++steps_since_filter_ < every) return;
  steps_since_filter_ = 0;
  refresh_lists();
  const InterpolationSource<N> source = interpolation_source();
  auto density = store_.template get<rho>();
  const std::size_t first = store_.range(Group::fluid).begin;
  std::vector<double> summed(store_.range(Group::fluid).size());
  for_each_particle(store_, Group::fluid,
                    [&](std::size_t i) { summed[i - first] = reproduced_density(source, i, order); });
  const double before = energies().total();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) { density[i] = summed[i - first]; });
  ledger_.diffusion += before - energies().total();
}

}  // namespace undine
