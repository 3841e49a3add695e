#pragma once
#include "undine/io/case/table.hpp"

namespace undine {

/// When the watchdog stops a run: [watchdog]. They change no result, only whether the run goes on.
struct WatchLimits {
  bool active = true;
  double density = 0.5;      ///< largest |rho/rho_0 - 1| of a stiff liquid; a summed density may be as low as it likes
  double closest = 0.01;     ///< distance at which particles coincide, spacings
  double coincident = 0.05;  ///< largest share of particles that do; in 1-D, where they cannot pass, none may
  double clumped = 0.2;      ///< largest share of particles with another one nearer than 0.3 spacings
  double isolated = 0.2;     ///< largest share of a gas's particles without a neighbour within their support
  double residual = 0.25;    ///< largest jump of the audit's residual, of the largest energy so far
  double smallest_step = 1e-4;  ///< of the step that sound and viscosity allow at rest, or evenly spread energy a gas
};

/// Reads [watchdog].
inline WatchLimits read_watch_limits(const Table& root) {
  const Table table = root.table("watchdog");
  WatchLimits limits;
  limits.active = table.flag("active", limits.active);
  limits.density = table.in_range("density", unit::one, {1e-3, 1e6}, limits.density);
  limits.closest = table.in_range("closest", unit::one, {0, 1}, limits.closest);
  limits.coincident = table.in_range("coincident", unit::one, {0, 1}, limits.coincident);
  limits.clumped = table.in_range("clumped", unit::one, {0, 1}, limits.clumped);
  limits.isolated = table.in_range("isolated", unit::one, {0, 1}, limits.isolated);
  limits.residual = table.in_range("residual", unit::one, {1e-6, 1e9}, limits.residual);
  limits.smallest_step = table.in_range("smallest_step", unit::one, {0, 1}, limits.smallest_step);
  return limits;
}

}  // namespace undine
