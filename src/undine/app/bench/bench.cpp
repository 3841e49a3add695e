#include "undine/app/bench/bench.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include "undine/app/bench/flops.hpp"
#include "undine/app/bench/hardware.hpp"
#include "undine/app/bench/measure.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

constexpr int splash_particles = 100000;  ///< the one size of the splash unless the user names some
constexpr int steps_per_snapshot = 100;

BenchOptions filled(BenchOptions options) {
  const auto fill = [](auto& list, auto defaults) {
    if (list.empty()) list.assign(defaults.begin(), defaults.end());
  };
  using Numbers = std::vector<int>;
  using Words = std::vector<std::string>;
  const int cores = omp_get_max_threads();
  fill(options.threads, cores > 1 ? Numbers{1, cores} : Numbers{1});
  fill(options.states, Words(bench_state_names.begin(), bench_state_names.end()));
  fill(options.neighbours, Numbers{74, 174});
  fill(options.precisions, options.quick ? Words{"mixed"} : Words{"mixed", "double"});
  if (options.repeats == 0) options.repeats = options.quick ? 3 : 5;
  return options;
}

std::vector<int> sizes(const BenchOptions& options, BenchStateKind kind) {
  if (!options.particles.empty()) return options.particles;
  if (options.quick) return {20000};
  return kind == BenchStateKind::splash ? std::vector<int>{splash_particles} : std::vector<int>{100000, 1000000};
}

/// What the machine can do at most for each precision and number of threads, measured when first asked for.
class Peaks {
 public:
  double of(PairPrecision precision, int threads) {
    const auto key = std::pair(precision, threads);
    if (!peaks_.contains(key)) peaks_[key] = measured_fma_peak(precision, threads);
    return peaks_[key];
  }
  double bandwidth(int threads) {
    if (!bandwidths_.contains(threads)) bandwidths_[threads] = measured_bandwidth(threads);
    return bandwidths_[threads];
  }

 private:
  std::map<int, double> bandwidths_;
  std::map<std::pair<PairPrecision, int>, double> peaks_;
};

/// The rows of one state in one precision.
class Sheet {
 public:
  Sheet(const BenchOptions& options, const BenchStateOptions& what, Peaks& peaks)
      : options_(options), what_(what), peaks_(peaks), subject_(make_bench_state(what)) {
    seconds_output_ = subject_.seconds_snapshot() / steps_per_snapshot;
    flops_ = subject_.pairs().from_fluid * flops_per_pair(Group::fluid) +
             subject_.pairs().from_wall * flops_per_pair(Group::wall);
  }

  void print_head() const {
    const BenchPairs& pairs = subject_.pairs();
    const BenchBytes bytes = subject_.bytes();
    fmt::print(
        "\n{}, {}: {:.0f} particles of fluid, {:.0f} of walls; H = {:.2f} dp, neighbours {:.1f} mean, {:.0f} bulk\n"
        "bytes per particle: {:.0f} without lists ({:.0f} fields, {:.0f} work space, {:.0f} cells), {:.0f} lists; "
        "{:.0f} flops per pair; a snapshot takes "
        "{:.2f} s\n"
        "{:<13} {:>7} {:>9} {:>15} {:>8} {:>6} {:>7} | ns per particle and step:\n"
        "{:<13} {:>7} {:>9} {:>15} {:>8} {:>6} {:>7} | {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}\n",
        state_name(), precision_name(), subject_.fluid(), subject_.particles() - subject_.fluid(),
        what_.support_over_spacing, pairs.mean, pairs.bulk, bytes.list_free(), bytes.fields, bytes.work, bytes.cells,
        bytes.lists, flops_per_pair(Group::fluid), seconds_output_ * steps_per_snapshot, "", "", "M steps", "",
        "M pairs", "% of", "builds", "row", "threads", "per s", "slowest-fastest", "per s", "peak", "a step", "all",
        "sort", "list", "sweep", "update", "output");
  }

  void add_rows(Json& rows) {
    for (const int threads : options_.threads)
      for (const BenchWork work : {BenchWork::force_pass, BenchWork::step, BenchWork::step_leapfrog}) {
        const BenchTiming timing = subject_.time(work, threads, {options_.repeats, options_.quick ? 0.4 : 1e300});
        if (!options_.json) print(work, threads, timing);
        rows.push_back(row(work, threads, timing));
      }
  }

 private:
  std::string_view state_name() const { return bench_state_names[static_cast<int>(what_.kind)]; }
  std::string_view precision_name() const { return precision_names[static_cast<int>(what_.precision)]; }
  /// A pass writes no output.
  double output(BenchWork work) const { return work == BenchWork::force_pass ? 0 : seconds_output_; }
  double pairs() const { return subject_.pairs().from_fluid + subject_.pairs().from_wall; }

  /// Of the force pass and of steps whose only sweep is that: otherwise the flops of the others are not known.
  double peak_share(BenchWork work, int threads, const BenchTiming& timing) {
    const bool only_force =
        work == BenchWork::force_pass || (work == BenchWork::step && what_.kind == BenchStateKind::block);
    return only_force ? flops_ / timing.median.sweep / peaks_.of(what_.precision, threads) : 0;
  }

  void print(BenchWork work, int threads, const BenchTiming& timing) {
    const BenchSample& t = timing.median;
    const double ns = 1e9 / subject_.fluid();
    const double share = peak_share(work, threads, timing);
    fmt::print(
        "{:<13} {:>7} {:>9.3f} {:>7.3f}-{:<7.3f} {:>8.0f} {:>6} {:>7.2f} | {:>6.0f} {:>6.1f} {:>6.1f} {:>6.1f} "
        "{:>6.1f} {:>6.1f}\n",
        bench_work_names[static_cast<int>(work)], threads, 1e-6 * subject_.fluid() / t.total,
        1e-6 * subject_.fluid() / timing.slowest, 1e-6 * subject_.fluid() / timing.fastest, 1e-6 * pairs() / t.total,
        share > 0 ? fmt::format("{:.1f}", 100 * share) : "-", t.builds, ns * t.total, ns * t.sort, ns * t.list,
        ns * t.sweep, ns * t.update(), ns * output(work));
    std::fflush(stdout);
  }

  Json row(BenchWork work, int threads, const BenchTiming& timing) {
    const BenchSample& t = timing.median;
    const BenchBytes bytes = subject_.bytes();
    const double share = peak_share(work, threads, timing);
    return {{"name", bench_work_names[static_cast<int>(work)]},
            {"state", state_name()},
            {"particles", std::lround(subject_.fluid())},
            {"wall_particles", std::lround(subject_.particles() - subject_.fluid())},
            {"neighbours", subject_.pairs().mean},
            {"neighbours_bulk", subject_.pairs().bulk},
            {"support_over_spacing", what_.support_over_spacing},
            {"threads", threads},
            {"precision", precision_name()},
            {"particle_steps_per_s", subject_.fluid() / t.total},
            {"particle_steps_per_s_slowest", subject_.fluid() / timing.slowest},
            {"particle_steps_per_s_fastest", subject_.fluid() / timing.fastest},
            {"pairs_per_s", pairs() / t.total},
            {"peak_share", share > 0 ? Json(share) : Json()},
            {"peak_flops_per_s", peaks_.of(what_.precision, threads)},
            {"memory_bytes_per_s", peaks_.bandwidth(threads)},
            {"flops_per_pair", flops_per_pair(Group::fluid)},
            {"builds_per_step", t.builds},
            {"seconds_per_step",
             {{"total", t.total},
              {"sort", t.sort},
              {"list", t.list},
              {"sweep", t.sweep},
              {"update", t.update()},
              {"output", output(work)}}},
            {"bytes_per_particle",
             {{"fields", bytes.fields},
              {"work", bytes.work},
              {"cells", bytes.cells},
              {"list_free", bytes.list_free()},
              {"lists", bytes.lists}}},
            {"repeats", timing.repeats},
            {"hardware", bench_hardware()},
            {"version", program_version()}};
  }

  const BenchOptions& options_;
  BenchStateOptions what_;
  Peaks& peaks_;
  BenchSubject subject_;
  double seconds_output_ = 0;  ///< per step
  double flops_ = 0;           ///< of one force pass
};

template <class Names>
int place_of(std::string_view word, const Names& names) {
  return static_cast<int>(std::ranges::find(names, word) - names.begin());
}

}  // namespace

void add_bench_options(CLI::App& command, BenchOptions& options) {
  command.add_option("--particles", options.particles, "about how many of the fluid; one or several numbers")
      ->check(CLI::Range(1000, 100000000))
      ->delimiter(',');
  command.add_option("--neighbours", options.neighbours, "in the bulk, nominal: 74 is H = 2.6 dp, 174 is 3.46 dp")
      ->check(CLI::Range(10, 2000))
      ->delimiter(',');
  command.add_option("--threads", options.threads, "default: one, then all cores")
      ->check(CLI::Range(1, 1024))
      ->delimiter(',');
  command.add_option("--precision", options.precisions, "of pair arithmetic; default: both")
      ->check(CLI::IsMember(std::vector<std::string>(precision_names.begin(), precision_names.end())))
      ->delimiter(',');
  command.add_option("--state", options.states, "which particles; default: both")
      ->check(CLI::IsMember(std::vector<std::string>(bench_state_names.begin(), bench_state_names.end())))
      ->delimiter(',');
  command.add_option("--repeats", options.repeats, "timed repeats of ten steps from the same start; the median counts")
      ->check(CLI::Range(1, 1000));
  command.add_flag("--quick", options.quick, "a short set on few particles, about ten seconds");
  command.add_flag("--json", options.json, "an array of objects, for bench/compare");
}

int run_bench(const BenchOptions& given) {
  const BenchOptions options = filled(given);
  Json rows = Json::array();
  Peaks peaks;
  if (!options.json) {
    fmt::print("{}\nmedians of {} repeats of ten steps from the same start\n", bench_hardware(), options.repeats);
    for (const int threads : options.threads) {
      fmt::print("{} thread{}: memory {:.1f} GB/s", threads, threads == 1 ? "" : "s", 1e-9 * peaks.bandwidth(threads));
      for (const auto& word : options.precisions)
        fmt::print(", multiply-adds {:.0f} Gflop/s {}",
                   1e-9 * peaks.of(PairPrecision{place_of(word, precision_names)}, threads), word);
      fmt::print("\n");
    }
  }
  for (const auto& state : options.states)
    for (const int particles : sizes(options, BenchStateKind{place_of(state, bench_state_names)}))
      for (const int neighbours : options.neighbours)
        for (const auto& precision : options.precisions) {
          Sheet sheet(options,
                      {BenchStateKind{place_of(state, bench_state_names)}, particles, support_for(neighbours),
                       PairPrecision{place_of(precision, precision_names)}},
                      peaks);
          if (!options.json) sheet.print_head();
          sheet.add_rows(rows);
        }
  if (options.json) fmt::print("{}", to_text(rows));
  return 0;
}

}  // namespace undine
