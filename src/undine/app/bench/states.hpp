#pragma once
#include <array>
#include <string_view>

#include "undine/schemes/weakly_compressible.hpp"

namespace undine {

/// The particle sets that `undine bench` times.
enum class BenchStateKind {
  block,  ///< a cube of fluid in free fall, no walls
  splash  ///< a broken dam: a body, thin sheets, drops and single particles, a floor and two end walls
};
inline constexpr std::array<std::string_view, 2> bench_state_names{"block", "splash"};

/// What to make.
struct BenchStateOptions {
  BenchStateKind kind = BenchStateKind::block;
  int particles = 100000;             ///< of the fluid, about
  double support_over_spacing = 2.6;  ///< H/dp
  PairPrecision precision = PairPrecision::mixed;
};

/// A reproducible set of particles, the scheme that moves it, and its fixed time step.
struct BenchState {
  Store<3> store;
  WeaklyCompressibleOptions<3> options;
  double dt = 0;  ///< s
};

/// H/dp for which a sphere of radius H holds that many lattice points; 2.6 for 74, 3.46 for 174.
double support_for(int neighbours);

/// Particles, scheme and step. The step is the Courant limit of the sound speed; speeds are scaled so that the fastest
/// particle crosses 0.05 H, half of a skin of 0.1 H, in five steps (Mach 0.06, as in a dam break). A larger skin
/// therefore shows as fewer list builds, as it would in a run.
BenchState make_bench_state(const BenchStateOptions& options);

}  // namespace undine
