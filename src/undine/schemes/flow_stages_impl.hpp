#pragma once
// The moves of Runge-Kutta integrators (integrators/runge_kutta.hpp); included by flow.cpp alone.
#include <cmath>

#include "undine/schemes/flow.hpp"

namespace undine {

using namespace field;

template <int N>
void Flow<N>::start_stages(int slopes) {
  stages_ = evolved();
  for (Evolved& state : stages_) {
    state.start.take(store_, state.group, state.field);
    state.slopes.resize(static_cast<std::size_t>(slopes));
  }
  time_start_ = time_;
  ledger_start_ = ledger_;
}

template <int N>
void Flow<N>::take_slope(int k) {
  for (Evolved& state : stages_) {
    auto& slope = state.slopes[static_cast<std::size_t>(k)];
    slope.resize(state.rates.size());
    for (std::size_t r = 0; r < slope.size(); ++r) slope[r].take(store_, state.group, state.rates[r]);
  }
}

/// sum_j w_j slope_j of rate r of a particle, number by number.
template <int N>
Vec<N> Flow<N>::change(const Evolved& state, std::size_t r, std::int64_t id, std::span<const double> weights) const {
  Vec<N> sum;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    if (weights[j] == 0) continue;
    const auto slope = state.slopes[j][r].of(id);
    for (std::size_t k = 0; k < slope.size(); ++k) sum[static_cast<int>(k)] += weights[j] * slope[k];
  }
  return sum;
}

template <int N>
double Flow<N>::take_stage(std::span<const double> weights) {
  double dt = 0, corrected = 0;
  for (const double w : weights) dt += w;
  const auto ids = store_.ids();
  const auto mass = store_.template get<m>();
  for (const Evolved& state : stages_) {
    double* to = store_.raw(state.field).data();
    const auto width = static_cast<std::size_t>(all_fields[state.field].components(N));
    corrected += total_over(store_, state.group, [&](std::size_t i) {
      Vec<N> sum;
      double work = 0;
      for (std::size_t r = 0; r < state.rates.size(); ++r) {
        const Vec<N> part = change(state, r, ids[i], weights);
        sum += part;
        if (state.rates[r] == v_xsph::id) work += mass[i] * dot(common_->gravity, part);
      }
      const auto start = state.start.of(ids[i]);
      for (std::size_t k = 0; k < width; ++k) to[i * width + k] = start[k] + sum[static_cast<int>(k)];
      return work;
    });
  }
  time_ = time_start_ + dt;
  move_walls();
  limit_state();
  return corrected;
}

template <int N>
void Flow<N>::stage(std::span<const double> weights) {
  take_stage(weights);
}

template <int N>
void Flow<N>::finish(std::span<const double> weights) {
  ledger_.xsph += take_stage(weights);
  place_surfaces(time_);
  if (!common_->reflector) return;
  auto at = store_.template get<x>();
  auto u = store_.template get<v>();
  const auto ids = store_.ids();
  const auto mass = store_.template get<m>();
  const Evolved& place = stages_.front();
  ledger_.walls += total_over(store_, Group::fluid, [&](std::size_t i) {
    Vec<N> moved;
    for (std::size_t r = 0; r < place.rates.size(); ++r) moved += change(place, r, ids[i], weights);
    // From where it set out on the side of a period on which it is now.
    const Bounce<N> bounce = common_->reflector(at[i] - moved, at[i], u[i]);
    const double given =
        mass[i] * (dot(common_->gravity, bounce.x - at[i]) + 0.5 * (norm_sq(u[i]) - norm_sq(bounce.v)));
    at[i] = bounce.x;
    u[i] = bounce.v;
    return given;
  });
}

/// The largest error of a particle: of places in supports, of velocities in the largest speed of sound or motion, of
/// scalars in their largest value.
template <int N>
double Flow<N>::stage_error(std::span<const double> weights) const {
  const auto ids = store_.ids();
  const auto u = store_.template get<v>();
  const auto sound = store_.template get<c>();
  double worst = 0;
  for (const Evolved& state : stages_) {
    double scale = support_now_;
    if (state.field == v::id)
      scale = largest_over(store_, state.group, 0.0, [&](std::size_t i) { return std::max(sound[i], norm(u[i])); });
    const auto values = store_.raw(state.field);
    if (all_fields[state.field].rank == Rank::scalar)
      scale = largest_over(store_, state.group, 0.0, [&](std::size_t i) { return std::abs(values[i]); });
    const double error = largest_over(store_, state.group, 0.0, [&](std::size_t i) {
      Vec<N> sum;
      for (std::size_t r = 0; r < state.rates.size(); ++r) sum += change(state, r, ids[i], weights);
      const double size = norm(sum);
      return std::isfinite(size) ? size : std::numeric_limits<double>::max();
    });
    if (error > 0) worst = std::max(worst, error / scale);
  }
  return worst;
}

template <int N>
void Flow<N>::reject() {
  for (const Evolved& state : stages_) state.start.give_back(store_, state.group, state.field);
  time_ = time_start_;
  ledger_ = ledger_start_;
  move_walls();
  evaluate();
}

}  // namespace undine
