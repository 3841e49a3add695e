#include "undine/app/setup/wall_motion.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace undine {
namespace {

constexpr int samples = 1000;  ///< instants until time.end at which a motion is looked at

/// Calls f(t) for instants from 0 to `end`.
template <class F>
void for_sampled_times(double end, F&& f) {
  for (int k = 0; k <= samples; ++k) f(end * k / samples);
}

template <int N>
typename WallMotion<N>::State state_of(const std::vector<Expression>& formulas, double t) {
  typename WallMotion<N>::State state;
  for (int k = 0; k < N; ++k) {
    const auto rates = formulas[static_cast<std::size_t>(k)].rates(0, 0, 0, t);
    state.displacement[k] = rates.value;
    state.velocity[k] = rates.first;
    state.acceleration[k] = rates.second;
  }
  return state;
}

template <int N>
std::function<typename WallMotion<N>::State(double)> read_displacement(const Table& table, double end,
                                                                       double& fastest) {
  const auto formulas = table.expressions("displacement", N);
  for (const auto& formula : formulas)
    if (formula.uses_position())
      table.fail("displacement", fmt::format("'{}' is not a function of time alone", formula.source()),
                 "a wall moves as a whole", "use t only; 'slide' may depend on x, y, z");
  const auto state = [formulas](double t) { return state_of<N>(formulas, t); };
  if (const double begin = norm(state(0).displacement); !(begin < 1e-12))
    table.fail("displacement", fmt::format("the wall is displaced by {:.4g} m at t = 0", begin),
               "its shape says where it begins", "subtract the formula's value at t = 0");
  for_sampled_times(end, [&](double t) {
    const auto s = state(t);
    if (!std::isfinite(norm(s.displacement) + norm(s.velocity) + norm(s.acceleration)))
      table.fail("displacement", fmt::format("the wall has no place, velocity or acceleration at t = {:.6g} s", t),
                 "the formula or one of its derivatives is not finite there", "choose a smoother formula");
    fastest = std::max(fastest, norm(s.velocity));
  });
  return state;
}

template <int N>
std::function<Vec<N>(const Vec<N>&, double)> read_slide(const Table& table, double end, double& fastest) {
  const auto formulas = table.expressions("slide", N);
  const auto slide = [formulas](const Vec<N>& x, double t) {
    Vec3 at{};
    for (int k = 0; k < N; ++k) at[k] = x[k];
    Vec<N> v;
    for (int k = 0; k < N; ++k) v[k] = formulas[static_cast<std::size_t>(k)](at[0], at[1], at[2], t);
    return v;
  };
  if (std::ranges::any_of(formulas, &Expression::uses_position)) return slide;
  for_sampled_times(end, [&](double t) {
    const double speed = norm(slide({}, t));
    if (!std::isfinite(speed))
      table.fail("slide", fmt::format("the wall has no velocity at t = {:.6g} s", t), "the formula is not finite there",
                 "choose a formula that is");
    fastest = std::max(fastest, speed);
  });
  return slide;
}

}  // namespace

template <int N>
std::optional<WallMotion<N>> read_wall_motion(const Table& table, const SchemeChoice& choice,
                                              const std::vector<PlacedSurface>& surfaces, double& fastest) {
  WallMotion<N> motion;
  if (table.has("displacement")) {
    motion.rigid = read_displacement<N>(table, choice.end, fastest);
    if (!surfaces.empty())
      motion.place_surface = [surfaces](const typename WallMotion<N>::State& state) {
        Vec3 offset{}, velocity{};
        for (int k = 0; k < N; ++k) offset[k] = state.displacement[k], velocity[k] = state.velocity[k];
        for (const auto& [surface, wall] : surfaces) surface->place(wall, offset, velocity);
      };
  }
  // A surface that slides moves nobody by reflecting or pushing, so only particles ask.
  if (choice.wall_particles && table.has("slide")) motion.slide = read_slide<N>(table, choice.end, fastest);
  if (!motion.rigid && !motion.slide) return {};
  return motion;
}

template std::optional<WallMotion<1>> read_wall_motion<1>(const Table&, const SchemeChoice&,
                                                          const std::vector<PlacedSurface>&, double&);
template std::optional<WallMotion<2>> read_wall_motion<2>(const Table&, const SchemeChoice&,
                                                          const std::vector<PlacedSurface>&, double&);
template std::optional<WallMotion<3>> read_wall_motion<3>(const Table&, const SchemeChoice&,
                                                          const std::vector<PlacedSurface>&, double&);

}  // namespace undine
