#pragma once
// The moves of Runge-Kutta integrators, included by flow.cpp.
#include <numeric>

#include "undine/schemes/flow.hpp"

namespace undine {

template <int N>
void Flow<N>::start_stages(int slopes, double dt) {
  std::vector<int> fields;
  for (const auto& kept : kept_of_a_step()) fields.push_back(kept.field);
  stages_.start(store_, fields, slopes);
  stage_dt_ = dt;
  time_start_ = time_;
  ledger_start_ = ledger_;
  xsph_powers_.assign(static_cast<std::size_t>(slopes), 0);
  remembered_start_.clear();
  for (const double* number : remembered()) remembered_start_.push_back(*number);
}

/// Positions change by the velocity and what is added to it, everything else as kick and compress say. Walls' particles
/// go with their walls.
template <int N>
void Flow<N>::take_slope(int k) {
  stages_.take(store_, k, stage_dt_, [&] {
    kick(stage_dt_);
    compress(stage_dt_);
  });
  const auto u = store_.template get<field::v>();
  const auto mass = store_.template get<field::m>();
  const auto correction = drift_correction();
  xsph_powers_[static_cast<std::size_t>(k)] = total_over(store_, Group::fluid, [&](std::size_t i) {
    const Vec<N> moved = correction.empty() ? Vec<N>{} : correction[i];
    stages_.put(store_, k, field::x::id, i, u[i] + moved);
    return mass[i] * dot(common_->gravity, moved);
  });
}

/// Within a step a particle that would be behind a reflecting wall is put before it, with the velocity it has; at the
/// end its path is reflected.
template <int N>
void Flow<N>::go_to(std::span<const double> weights, bool at_end) {
  time_ = time_start_ + std::accumulate(weights.begin(), weights.end(), 0.0);
  for (const int f : stages_.fields()) {
    stages_.write(store_, Group::fluid, weights, f);
    if (f != field::x::id && f != field::v::id) stages_.write(store_, Group::wall, weights, f);
  }
  place_surfaces(time_);
  move_walls();
  if (at_end)
    for (std::size_t k = 0; k < weights.size(); ++k) ledger_.xsph += weights[k] * xsph_powers_[k];
  if (!common_->reflector) return;
  auto at = store_.template get<field::x>();
  auto u = store_.template get<field::v>();
  const auto mass = store_.template get<field::m>();
  const double work = total_over(store_, Group::fluid, [&](std::size_t i) {
    Vec<N> from;
    for (int c = 0; c < N; ++c) from[c] = stages_.combined(store_, {}, field::x::id, i, c);
    const Vec<N> to = at[i];
    const Bounce<N> bounce = common_->reflector(from, to, u[i]);
    at[i] = bounce.x;
    if (!at_end) return 0.0;
    const double lost = mass[i] * (dot(common_->gravity, bounce.x - to) + 0.5 * (norm_sq(u[i]) - norm_sq(bounce.v)));
    u[i] = bounce.v;
    return lost;
  });
  ledger_.walls += work;
}

template <int N>
double Flow<N>::stage_error(std::span<const double> weights) const {
  const auto sound = store_.template get<field::c>();
  const auto density = store_.template get<field::rho>();
  const bool has_energy = stages_.keeps(field::e::id);
  const double sum = total_over(store_, Group::fluid, [&](std::size_t i) {
    const auto change = [&](int f, int c) { return stages_.change(store_, weights, f, i, c); };
    double square = sq(change(field::rho::id, 0) / density[i]);
    for (int c = 0; c < N; ++c) square += sq(change(field::v::id, c) / sound[i]);
    if (has_energy) square += sq(change(field::e::id, 0) / sq(sound[i]));
    return square;
  });
  const std::size_t particles = store_.range(Group::fluid).size();
  return particles == 0 ? 0 : std::sqrt(sum / static_cast<double>(particles));
}

template <int N>
void Flow<N>::reject() {
  go_to({}, false);
  auto number = remembered_start_.begin();
  for (double* account : remembered()) *account = *number++;
  ledger_ = ledger_start_;
  evaluate();
}

template <int N>
Step Flow<N>::next_step(const StepLimits& limits) const {
  const Step step = stable_step(limits);
  const auto& control = step_control_;
  if (!control.adapts() || control.proposed <= 0 || control.proposed >= step.dt) return step;
  return {control.proposed, "tolerance"};
}

}  // namespace undine
