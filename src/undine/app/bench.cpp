#include "undine/app/bench.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include "undine/integrators/leapfrog.hpp"
#include "undine/io/run_record.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {
namespace {

/// A cube of fluid on a lattice that is jittered by 10 % and turned out of the axes: an aligned lattice flatters every
/// blocked scheme.
Store<3> rotated_block(int side, double dp, double H) {
  Store<3> store;
  using namespace field;
  store.allocate(Fields<x, v, rho, h, m, rho_0, rho_wall, mu, x_list>::set());
  store.append(Group::fluid, static_cast<std::size_t>(side) * side * side, 0);
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 11) * 0x1p-52 - 1.0;
  };
  const double c1 = std::cos(0.5), s1 = std::sin(0.5), c2 = std::cos(0.7), s2 = std::sin(0.7);
  std::size_t i = 0;
  for (int a = 0; a < side; ++a)
    for (int b = 0; b < side; ++b)
      for (int c = 0; c < side; ++c, ++i) {
        Vec<3> p{{a + 0.1 * random(), b + 0.1 * random(), c + 0.1 * random()}};
        p = {{c1 * p[0] - s1 * p[1], s1 * p[0] + c1 * p[1], p[2]}};
        store.get<x>()[i] = dp * Vec<3>{{p[0], c2 * p[1] - s2 * p[2], s2 * p[1] + c2 * p[2]}};
        store.get<v>()[i] = {{0.1 * random(), 0.1 * random(), 0.1 * random()}};
        store.get<rho>()[i] = 1000 + random();
        store.get<h>()[i] = H;
        store.get<m>()[i] = 1000 * dp * dp * dp;
        store.get<rho_0>()[i] = 1000;
        store.get<mu>()[i] = 1e-3;
      }
  return store;
}

struct Rate {
  double steps_per_s, pairs_per_s, neighbours, sweep_share, list_share;
};

Rate time_steps(const BenchOptions& bench, double support, PairPrecision precision, int threads) {
  omp_set_num_threads(threads);
  const int side = static_cast<int>(std::lround(std::cbrt(bench.particles)));
  const double dp = 0.01;
  WeaklyCompressibleOptions<3> options;
  options.support = {.uniform = support * dp};
  options.artificial = terms::ViscosityMonaghan{};
  options.diffusion = OneOf<terms::DiffusionForms>{};
  options.xsph = terms::Xsph{};
  options.materials = {materials::Material{}};
  options.backend.precision = precision;
  WeaklyCompressible<3> flow(rotated_block(side, dp, support * dp), Domain<3>::unbounded(), options);
  const auto n = static_cast<double>(flow.store().size());
  std::vector<double> times;
  const int steps = 5;
  double sweeps = 0, lists = 0;
  for (int r = 0; r < bench.repeats; ++r) {
    const double s0 = flow.seconds_sweeps(), l0 = flow.seconds_lists();
    const auto start = std::chrono::steady_clock::now();
    for (int k = 0; k < steps; ++k) integrators::Leapfrog::step(flow, flow.stable_step({}).dt);
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / steps);
    sweeps += (flow.seconds_sweeps() - s0) / times.back() / steps;
    lists += (flow.seconds_lists() - l0) / times.back() / steps;
  }
  std::ranges::sort(times);
  const double median = times[times.size() / 2];
  const double skin = std::pow(1.1, 3);
  const double neighbours = static_cast<double>(flow.neighbours().pair_count(Group::fluid, Group::fluid)) / n / skin;
  return {n / median, n * neighbours / median, neighbours, sweeps / bench.repeats, lists / bench.repeats};
}

}  // namespace

void add_bench_options(CLI::App& command, BenchOptions& options) {
  command.add_option("--particles", options.particles, "about how many")->check(CLI::Range(1000, 100000000));
  command.add_option("--repeats", options.repeats, "timed repeats of 5 steps; the median counts")
      ->check(CLI::Range(1, 1000));
  command.add_option("--threads", options.threads, "0: one, then all cores")->check(CLI::Range(0, 1024));
  command.add_flag("--json", options.json, "an array of objects");
}

int run_bench(const BenchOptions& bench) {
  std::vector<int> threads{1};
  if (const int all = omp_get_max_threads(); all > 1) threads.push_back(all);
  if (bench.threads > 0) threads = {bench.threads};
  Json rows = Json::array();
  if (!bench.json)
    fmt::print(
        "whole leapfrog steps (continuity, lists, pressure, alpha, XSPH, diffusion, step limit), {} particles, median "
        "of {}\n"
        "{:>9} {:>8} {:>11} {:>16} {:>12} {:>8} {:>8}\n",
        bench.particles, bench.repeats, "precision", "threads", "neighbours", "particle-steps/s", "pairs/s", "sweeps",
        "lists");
  for (const double support : {2.6, 3.46})
    for (const auto precision : {PairPrecision::mixed, PairPrecision::double_precision})
      for (const int t : threads) {
        const Rate r = time_steps(bench, support, precision, t);
        const auto name = precision_names[static_cast<int>(precision)];
        rows.push_back({{"name", "step"},
                        {"particles", bench.particles},
                        {"neighbours", r.neighbours},
                        {"threads", t},
                        {"precision", name},
                        {"particle_steps_per_s", r.steps_per_s},
                        {"pairs_per_s", r.pairs_per_s}});
        if (!bench.json)
          fmt::print("{:>9} {:>8} {:>11.0f} {:>14.3g} M {:>10.3g} M {:>6.0f} % {:>6.0f} %\n", name, t, r.neighbours,
                     r.steps_per_s * 1e-6, r.pairs_per_s * 1e-6, 100 * r.sweep_share, 100 * r.list_share);
      }
  if (bench.json) fmt::print("{}", to_text(rows));
  return 0;
}

}  // namespace undine
