#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "undine/core/vec.hpp"

namespace undine {

/// How a wall moves: rigidly, as a function of time, and with a surface that slides within itself.
template <int N>
struct WallMotion {
  struct State {
    Vec<N> displacement{};  ///< m, from where the case puts the wall
    Vec<N> velocity{};      ///< m/s, its time derivative
    Vec<N> acceleration{};  ///< m/s^2
  };
  std::function<State(double t)> rigid;                    ///< empty: it stays where it is
  std::function<Vec<N>(const Vec<N>& x, double t)> slide;  ///< m/s, added to the velocity; empty: none
  std::function<void(const State&)> place_surface;         ///< moves what reflects or pushes; empty: nothing does

  State state(double t) const { return rigid ? rigid(t) : State{}; }
};

/// What a run knows of walls beyond the fields of their particles. Particles are told apart by id, as their order
/// changes.
template <int N>
struct WallPlan {
  std::vector<WallMotion<N>> motions;  ///< of the walls that move
  std::int64_t first_id = 0;           ///< of the walls' particles
  std::vector<std::int32_t> motion;    ///< of each wall particle: which of the motions, -1 for none
  std::vector<Vec<N>> start;           ///< m, of each wall particle: its place without displacement
  std::vector<Vec<N>> to_mirror;       ///< m, of each wall particle: from it to its mirror image in the fluid

  bool moves() const { return !motions.empty(); }
};

}  // namespace undine
