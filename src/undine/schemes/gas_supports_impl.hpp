#pragma once
// How Gas<N> finds density and support by each other; included by gas_impl.hpp alone.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "undine/schemes/gas.hpp"
#include "undine/schemes/state_error.hpp"
#include "undine/terms/density/grad_h.hpp"

namespace undine {
namespace {

using namespace field;

}  // namespace

/// Where the search for H sets out from: dH/dt = H div v/N.
template <int N>
void Gas<N>::foresee_supports(double dt) {
  if (!options_.iterates() || !options_.takes_velocity_gradient()) return;
  auto H = store_.template get<h>();
  const auto L = store_.template get<strain>();
  for_each_particle(store_, Group::fluid, [&](std::size_t i) {
    H[i] *= std::exp(std::clamp(dt * terms::divergence<N>(L[i]) / N, -0.1, 0.1));
  });
}

/// Density and support of every particle so that rho H^N = m q^N. Springel & Hernquist (2002); Price (2012).
template <int N>
void Gas<N>::find_supports() {
  constexpr int most_rounds = 100;
  SupportSearch search;
  long builds = -1;
  for (int round = 0; round < most_rounds; ++round) {
    if (this->list_builds() != builds) {  // particles were sorted: begin anew
      const std::size_t count = store_.range(Group::fluid).size();
      search.brackets.assign(count, Vec<2>{{0, std::numeric_limits<double>::max()}});
      search.open.assign(count, 1);
      builds = this->list_builds();
    }
    this->run(density_, search.open);  // a sum sees no H but the target's own: those that were found stay
    if (!adapt_supports(search)) {
      const auto H = store_.template get<h>();
      const auto sum = store_.template get<rho_sum>(), slope = store_.template get<rho_sum_h>();
      auto density = store_.template get<rho>(), factor = store_.template get<omega>();
      for_each_particle(store_, Group::fluid, [&](std::size_t i) {
        density[i] = sum[i];
        // Of a particle at the brink of having no neighbours it would be 0.
        factor[i] = std::max(0.05, terms::grad_h_factor<N>(H[i], sum[i], slope[i]));
      });
      if (ghosts_) ghosts_->mirror(store_, Fields<h>::set());
      return;
    }
    this->refresh_lists();  // which a larger H may outgrow
  }
  no_support_found();
}

/// One round of Newton's method with bisection where that would leave what is known to hold the solution. Whether some
/// H changed.
template <int N>
bool Gas<N>::adapt_supports(SupportSearch& search) {
  const bool in_float =
      options_.backend.kind == BackendKind::threads && options_.backend.precision == PairPrecision::mixed;
  const double tolerance = in_float ? 3e-6 : 1e-11;
  const double q = options_.support_over_spacing;
  const std::size_t first = store_.range(Group::fluid).begin;
  auto H = store_.template get<h>();
  const auto mass = store_.template get<m>(), sum = store_.template get<rho_sum>(),
             slope = store_.template get<rho_sum_h>();
  const double changed = total_over(store_, Group::fluid, [&](std::size_t i) {
    if (!search.open[i - first]) return 0.0;
    const terms::SupportState state{mass[i], H[i], sum[i], slope[i]};
    const double mismatch = terms::support_mismatch<N>(state, q);
    Vec<2>& bracket = search.brackets[i - first];
    if (mismatch > 0) {
      bracket[1] = std::min(bracket[1], H[i]);
    } else {
      bracket[0] = std::max(bracket[0], H[i]);
    }
    // A kernel that jumps at its edge leaves a bracket without a solution.
    if (std::abs(mismatch) <= tolerance || bracket[1] - bracket[0] <= 0.01 * tolerance * H[i]) {
      search.open[i - first] = 0;
      return 0.0;
    }
    const double next = terms::next_support<N>(state, q);
    H[i] = next > bracket[0] && next < bracket[1] ? next : std::sqrt(bracket[0] * bracket[1]);
    return 1.0;
  });
  return changed > 0;
}

template <int N>
void Gas<N>::no_support_found() const {
  const auto H = store_.template get<h>();
  const auto mass = store_.template get<m>(), sum = store_.template get<rho_sum>();
  const auto mismatch = [&](std::size_t i) {
    return std::abs(sum[i] / mass[i] * std::pow(H[i] / options_.support_over_spacing, N) - 1);
  };
  const IndexRange fluid = store_.range(Group::fluid);
  std::size_t worst = fluid.begin;
  for (std::size_t i = fluid.begin; i < fluid.end; ++i)
    if (!(mismatch(i) <= mismatch(worst))) worst = i;
  throw StateError(Trouble::support, store_.ids()[worst],
                   {.what = fmt::format("no support radius fits the density of particle {} at t = {:.6g} s",
                                        store_.ids()[worst], time_),
                    .why = fmt::format("after 100 rounds H = {:.6g} m, rho = {:.6g} kg/m^3", H[worst], sum[worst]),
                    .fix = "look for particles that coincide, or take scheme.smoothing.law = \"density\""});
}

}  // namespace undine
