#pragma once
#include <algorithm>
#include <chrono>
#include <cstdint>

namespace undine {

/// How far a run is, and how fast it goes.
struct Pace {
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  Clock::time_point start = Clock::now();
  double from = 0, end = 0;  ///< s, simulated: where this process began, and where the run ends
  std::int64_t step = 0;
  double particle_updates = 0;
  double seconds_output = 0;
  double seconds_watch = 0;
  bool listens = false, paused = false;  ///< to whoever may pause and stop the run

  double seconds() const { return seconds_since(start); }
  /// Particle updates per second.
  double rate() const { return particle_updates / std::max(1e-9, seconds()); }
  /// Seconds that the rest takes at the pace so far.
  double remaining(double now) const { return now > from ? std::max(0.0, seconds() * (end - now) / (now - from)) : 0; }
};

}  // namespace undine
