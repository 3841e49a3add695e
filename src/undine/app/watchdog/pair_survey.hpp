#pragma once
#include <algorithm>
#include <limits>

#include "undine/schemes/flow.hpp"

namespace undine {

inline constexpr double clump_distance = 0.3;  ///< spacings

/// How near fluid particles have come to each other.
struct PairSurvey {
  double closest = std::numeric_limits<double>::infinity();  ///< m
  std::int64_t particle = -1;                                ///< id of one of the closest two
  std::size_t coincident = 0;  ///< particles with a neighbour nearer than a given distance
  std::size_t clumped = 0;     ///< particles with a neighbour nearer than 0.3 spacings
  std::size_t tense = 0;       ///< of those, with p < 0

  void join(const PairSurvey& other) {
    // Of several pairs as close, the lowest id: the answer does not depend on who came first.
    if (other.closest < closest || (other.closest == closest && other.particle < particle)) {
      closest = other.closest;
      particle = other.particle;
    }
    coincident += other.coincident;
    clumped += other.clumped;
    tense += other.tense;
  }
};

/// By the neighbour lists as they are. Particles nearer than `coincide` spacings count as coincident.
template <int N>
PairSurvey survey_pairs(const Flow<N>& flow, double spacing, double coincide = 0.01) {
  const Store<N>& store = flow.store();
  const auto x = store.template get<field::x>();
  const auto p = store.template get<field::p>();
  const std::size_t count = store.range(Group::fluid).size();
  PairSurvey survey;
#pragma omp parallel
  {
    typename Neighbours<N>::Scratch scratch;
    PairSurvey part;
#pragma omp for schedule(static) nowait
    for (std::size_t i = 0; i < count; ++i) {
      double nearest_sq = std::numeric_limits<double>::infinity();
      for (const std::uint32_t j : flow.neighbours().of(Group::fluid, i, Group::fluid, store, scratch))
        if (j != i) nearest_sq = std::min(nearest_sq, norm_sq(flow.domain().nearest_image(x[i] - x[j])));
      const bool clumped = nearest_sq < sq(clump_distance * spacing);
      part.join(
          {std::sqrt(nearest_sq), store.ids()[i], nearest_sq < sq(coincide * spacing), clumped, clumped && p[i] < 0});
    }
#pragma omp critical(undine_pair_survey)
    survey.join(part);
  }
  return survey;
}

}  // namespace undine
