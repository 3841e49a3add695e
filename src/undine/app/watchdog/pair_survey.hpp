#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "undine/schemes/gas.hpp"

namespace undine {

inline constexpr double clump_distance = 0.3;  ///< spacings

/// How near fluid particles have come to each other.
struct PairSurvey {
  double closest = std::numeric_limits<double>::infinity();  ///< spacings
  double distance = closest;                                 ///< m, of that pair
  std::int64_t particle = -1;                                ///< id of one of the two
  std::size_t coincident = 0;  ///< particles with a neighbour nearer than a given distance
  std::size_t clumped = 0;     ///< particles with a neighbour nearer than 0.3 spacings
  std::size_t tense = 0;       ///< of those, with p < 0
  std::size_t isolated = 0;    ///< particles without a neighbour within their own H
  std::int64_t lone = -1;      ///< id of one of those

  void join(const PairSurvey& other) {
    // Of several pairs as close, the lowest id: the answer does not depend on who came first.
    if (other.closest < closest || (other.closest == closest && other.particle < particle)) {
      closest = other.closest;
      distance = other.distance;
      particle = other.particle;
    }
    coincident += other.coincident;
    clumped += other.clumped;
    tense += other.tense;
    isolated += other.isolated;
    if (other.lone >= 0) lone = lone < 0 ? other.lone : std::min(lone, other.lone);
  }
};

/// The room that each particle of a gas takes, as the edge of a cube: (m/rho)^(1/N), m. Empty for a liquid, whose
/// spacing is that of the case.
template <int N>
std::vector<double> own_spacings(const Flow<N>& flow) {
  if (!dynamic_cast<const Gas<N>*>(&flow)) return {};
  const auto mass = flow.store().template get<field::m>(), density = flow.store().template get<field::rho>();
  std::vector<double> own(flow.store().range(Group::fluid).size());
  for_each_particle(flow.store(), Group::fluid,
                    [&](std::size_t i) { own[i] = std::pow(mass[i] / density[i], 1.0 / N); });
  return own;
}

/// By the neighbour lists as they are. Particles nearer than `coincide` spacings count as coincident; of a gas the
/// spacing of a pair is the smaller of its own two.
template <int N>
PairSurvey survey_pairs(const Flow<N>& flow, double spacing, double coincide = 0.01) {
  const Store<N>& store = flow.store();
  const auto x = store.template get<field::x>();
  const auto p = store.template get<field::p>();
  const auto H = store.template get<field::h>();
  const std::vector<double> own = own_spacings(flow);
  const auto room = [&](std::size_t i, std::size_t j) { return own.empty() ? spacing : std::min(own[i], own[j]); };
  const std::size_t count = store.range(Group::fluid).size();
  PairSurvey survey;
#pragma omp parallel
  {
    typename Neighbours<N>::Scratch scratch;
    PairSurvey part;
#pragma omp for schedule(static) nowait
    for (std::size_t i = 0; i < count; ++i) {
      PairSurvey one{.particle = store.ids()[i]};
      double nearest_sq = std::numeric_limits<double>::infinity(), share_sq = nearest_sq;
      for (const std::uint32_t j : flow.neighbours().of(Group::fluid, i, Group::fluid, store, scratch)) {
        if (j == i) continue;
        const double r_sq = norm_sq(flow.domain().nearest_image(x[i] - x[j]));
        nearest_sq = std::min(nearest_sq, r_sq);
        if (const double share = r_sq / sq(room(i, j)); share < share_sq) {
          share_sq = share;
          one.distance = std::sqrt(r_sq);
        }
      }
      one.closest = std::sqrt(share_sq);
      one.coincident = one.closest < coincide;
      one.clumped = one.closest < clump_distance;
      one.tense = one.clumped && p[i] < 0;
      one.isolated = !H.empty() && nearest_sq >= sq(H[i]);
      if (one.isolated) one.lone = one.particle;
      part.join(one);
    }
#pragma omp critical(undine_pair_survey)
    survey.join(part);
  }
  return survey;
}

}  // namespace undine
