#include "undine/app/bench/measure.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <vector>

#include <omp.h>
#include <unistd.h>

#include "undine/app/run/output.hpp"
#include "undine/core/error.hpp"
#include "undine/integrators/euler.hpp"
#include "undine/integrators/leapfrog.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

/// Steps of a repeat: two list builds' worth.
constexpr int steps_per_repeat = 10;
constexpr int passes_per_repeat = 5;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What the flow's clocks say.
BenchSample clocks(const WeaklyCompressible<3>& flow) {
  return {seconds_now(), flow.neighbours().seconds_sort(), flow.neighbours().seconds_lists(), flow.seconds_sweeps(),
          static_cast<double>(flow.list_builds())};
}

BenchPairs count_pairs(const WeaklyCompressible<3>& flow) {
  const auto& store = flow.store();
  const auto x = store.get<field::x>();
  const IndexRange fluid = store.range(Group::fluid);
  const double reach_sq = sq(flow.support());
  std::vector<int> neighbours(fluid.size());
  double from[group_count] = {};
  std::vector<std::uint32_t> scratch;
  for (std::size_t a = 0; a < fluid.size(); ++a)
    for (const Group source : all_groups) {
      if (store.range(source).size() == 0) continue;
      int inside = 0;
      for (const std::uint32_t b : flow.neighbours().of(Group::fluid, a, source, store, scratch))
        inside += b != a && norm_sq(x[a] - x[b]) < reach_sq;
      neighbours[a] += inside;
      from[static_cast<int>(source)] += inside;
    }
  const auto middle = neighbours.begin() + static_cast<std::ptrdiff_t>(neighbours.size() / 2);
  std::nth_element(neighbours.begin(), middle, neighbours.end());
  return {from[0], from[1], (from[0] + from[1]) / static_cast<double>(fluid.size()), static_cast<double>(*middle)};
}

}  // namespace

void run_force_pass(const WeaklyCompressible<3>& flow) {
  for (const Stage& stage : flow.plan().stages())
    if (stage.name == "force") stage.run();
}

BenchSubject::BenchSubject(BenchState state)
    : dt_(state.dt), flow_(std::move(state.store), Domain<3>::unbounded(), std::move(state.options)) {
  flow_.predict_kick(0);  // takes the memory that leapfrog takes
  bytes_ = measure_bytes();
  flow_.save();
  pairs_ = count_pairs(flow_);
}

BenchSample BenchSubject::one_repeat(BenchWork work) {
  flow_.restore();
  flow_.evaluate();
  const int count = work == BenchWork::force_pass ? passes_per_repeat : steps_per_repeat;
  const BenchSample before = clocks(flow_);
  for (int k = 0; k < count; ++k) {
    if (work == BenchWork::force_pass) run_force_pass(flow_);
    if (work == BenchWork::step) integrators::Euler::step(flow_, dt_);
    if (work == BenchWork::step_leapfrog) integrators::Leapfrog::step(flow_, dt_);
  }
  const BenchSample after = clocks(flow_);
  return {(after.total - before.total) / count, (after.sort - before.sort) / count, (after.list - before.list) / count,
          (after.sweep - before.sweep) / count, (after.builds - before.builds) / count};
}

BenchTiming BenchSubject::time(BenchWork work, int threads, const BenchPatience& patience) {
  const int threads_before = omp_get_max_threads();
  omp_set_num_threads(threads);
  std::vector<BenchSample> samples;
  const double start = seconds_now();
  for (int r = 0; r < patience.repeats && (r == 0 || seconds_now() - start < patience.seconds); ++r)
    samples.push_back(one_repeat(work));
  omp_set_num_threads(threads_before);
  std::ranges::sort(samples, {}, &BenchSample::total);
  return {samples[samples.size() / 2], samples.front().total, samples.back().total, static_cast<int>(samples.size())};
}

BenchBytes BenchSubject::measure_bytes() {
  const auto per_particle = [&](std::size_t bytes) { return static_cast<double>(bytes) / particles(); };
  const std::size_t work = flow_.store().workspace().bytes(), lists = flow_.neighbours().list_bytes();
  return {per_particle(flow_.store().bytes() - work), per_particle(work),
          per_particle(flow_.neighbours().bytes() - lists), per_particle(lists)};
}

double BenchSubject::seconds_snapshot() const {
  std::error_code failed;
  const fs::path folder = fs::temp_directory_path(failed) / ("undine_bench_" + std::to_string(getpid()));
  if (failed || !fs::create_directory(folder, failed)) return 0;
  double best = 0;
  try {
    for (int repeat = 0; repeat < 3; ++repeat) {
      const double start = seconds_now();
      std::vector<std::int32_t> groups;
      write_snapshot(folder / "bench.vtkhdf",
                     frame_of(flow_, 0, {FieldId::v, FieldId::rho, FieldId::p, FieldId::m}, groups));
      const double seconds = seconds_now() - start;
      best = repeat == 0 ? seconds : std::min(best, seconds);
    }
  } catch (const Error&) {
    best = 0;  // a full or read-only disk is no reason to give no other figure
  }
  fs::remove_all(folder, failed);
  return best;
}

}  // namespace undine
