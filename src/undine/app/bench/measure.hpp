#pragma once
#include <array>
#include <string_view>

#include "undine/app/bench/states.hpp"

namespace undine {

/// What a row of the bench times.
enum class BenchWork {
  force_pass,    ///< the fused force sweep alone
  step,          ///< a step of explicit Euler: one force pass
  step_leapfrog  ///< a step of leapfrog: a force pass and a continuity pass
};
inline constexpr std::array<std::string_view, 3> bench_work_names{"force pass", "step", "step leapfrog"};

/// Seconds of one step or pass, and where they went.
struct BenchSample {
  double total = 0, sort = 0, list = 0, sweep = 0;
  double builds = 0;  ///< list builds per step
  /// The rest: equation of state, integration, check of the lists, sums.
  double update() const { return total - sort - list - sweep; }
};

/// Several repeats of the very same work: they differ by the noise of the machine alone.
struct BenchTiming {
  BenchSample median;
  double fastest = 0, slowest = 0;
  int repeats = 0;
};

/// How often to repeat, and when to stop before: a row on a busy machine must not take minutes.
struct BenchPatience {
  int repeats = 5;
  double seconds = 1e300;
};

/// Pairs inside the support at the start, counted one by one; a particle is not its own neighbour.
struct BenchPairs {
  double from_fluid = 0, from_wall = 0;  ///< of fluid particles with fluid and with wall particles
  double mean = 0;                       ///< neighbours of a fluid particle, walls included
  double bulk = 0;                       ///< the median of the same: in a large body, that of its inside
};

/// Bytes per particle: of the fields; of the work space, which holds the records of a sweep; of the cells and codes by
/// which neighbours are found; of the stored lists.
struct BenchBytes {
  double fields = 0, work = 0, cells = 0, lists = 0;
  double list_free() const { return fields + work + cells; }
};

/// A state with its scheme, to be timed in several ways from the same start.
class BenchSubject {
 public:
  explicit BenchSubject(BenchState state);

  BenchTiming time(BenchWork work, int threads, const BenchPatience& patience);
  const BenchPairs& pairs() const { return pairs_; }
  const BenchBytes& bytes() const { return bytes_; }
  /// Seconds to write one snapshot of v, rho, p and m into a temporary folder, best of three; 0 when it cannot be
  /// written.
  double seconds_snapshot() const;

  double fluid() const { return static_cast<double>(flow_.store().range(Group::fluid).size()); }
  double particles() const { return static_cast<double>(flow_.store().size()); }
  WeaklyCompressible<3>& flow() { return flow_; }

 private:
  BenchSample one_repeat(BenchWork work);
  BenchBytes measure_bytes();

  double dt_;
  WeaklyCompressible<3> flow_;
  BenchPairs pairs_;
  BenchBytes bytes_;
};

/// Runs the fused force sweep of a flow alone, on the lists and fields at hand.
void run_force_pass(const WeaklyCompressible<3>& flow);

}  // namespace undine
