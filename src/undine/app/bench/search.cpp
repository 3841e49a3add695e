#include "undine/app/bench/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include "undine/analysis/growth.hpp"
#include "undine/app/bench/hardware.hpp"
#include "undine/app/bench/search_sets.hpp"
#include "undine/core/stopwatch.hpp"
#include "undine/io/run_record.hpp"
#include "undine/search/search.hpp"

namespace undine {
namespace {

constexpr int fewest_repeats = 3;
constexpr double enough_seconds = 4;    ///< no more repeats than the fewest after that
constexpr double longest_seconds = 20;  ///< of one repeat: sizes that would take longer are left out

/// What one search took on one set of points.
struct SearchTiming {
  double points = 0, neighbours = 0;  ///< neighbours: of a point on the mean, itself not counted
  double build = 0, query = 0;        ///< s: to build, and to find the neighbours of all points; medians
  double bytes = 0;
  int repeats = 0;
};

double median(std::vector<double> values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

template <class F>
double seconds_of(F&& f) {
  double seconds = 0;
  {
    const Stopwatch watch(seconds);
    f();
  }
  return seconds;
}

/// Builds and asks several times over. A build is timed from the second on, when the search has its memory, as in a
/// run.
SearchTiming time_search(const std::string& name, const SearchSet& set, int repeats) {
  const auto search = make_search<3>(name);
  const auto build = [&] { search->build(set.points, set.radius, Domain<3>::unbounded()); };
  std::vector<std::uint32_t> found;
  std::size_t pairs = 0;
  const auto ask_all = [&] {
    pairs = 0;
    for (const auto& x : set.points) {
      search->find(x, set.radius, found);
      pairs += found.size();
    }
  };
  std::vector<double> builds, queries;
  build();
  double total = 0;
  for (int r = 0; r < repeats && (r < fewest_repeats || total < enough_seconds); ++r) {
    builds.push_back(seconds_of(build));
    queries.push_back(seconds_of(ask_all));
    total += builds.back() + queries.back();
  }
  const auto points = static_cast<double>(set.points.size());
  return {points,          static_cast<double>(pairs) / points - 1, median(builds),
          median(queries), static_cast<double>(search->bytes()),    static_cast<int>(builds.size())};
}

/// How something grows, as a power of n and of n log n.
struct Growth {
  double n, n_log_n;
};
struct SearchGrowth {
  Growth build, query, bytes;
};

SearchGrowth growth_of(const std::vector<SearchTiming>& timings) {
  std::vector<double> n, n_log_n;
  for (const auto& timing : timings) {
    n.push_back(timing.points);
    n_log_n.push_back(timing.points * std::log(timing.points));
  }
  const auto fit = [&](double SearchTiming::*what) {
    std::vector<double> y;
    for (const auto& timing : timings) y.push_back(timing.*what);
    return Growth{growth_exponent(n, y), growth_exponent(n_log_n, y)};
  };
  return {fit(&SearchTiming::build), fit(&SearchTiming::query), fit(&SearchTiming::bytes)};
}

/// Seconds that a repeat with so many points will take, going by the first size and the last; by the number where there
/// is only one.
double expected_seconds(const std::vector<SearchTiming>& timings, double points) {
  if (timings.empty()) return 0;
  const auto seconds = [](const SearchTiming& t) { return t.build + t.query; };
  const SearchTiming& last = timings.back();
  double power = 1;
  if (timings.size() > 1 && last.points > timings.front().points) {
    const SearchTiming& first = timings.front();
    power = std::log(seconds(last) / seconds(first)) / std::log(last.points / first.points);
  }
  return seconds(last) * std::pow(points / last.points, power);
}

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }
std::string number_or_dash(double value) { return std::isfinite(value) ? fmt::format("{:.2f}", value) : "-"; }

void print_timing(const std::string& name, const SearchTiming& t) {
  fmt::print("{:<24} {:>9.0f} {:>10.1f} {:>10.4f} {:>10.4f} {:>9.0f} {:>9.0f} {:>9.1f}\n", name, t.points, t.neighbours,
             t.build, t.query, 1e9 * t.build / t.points, 1e9 * t.query / t.points, t.bytes / t.points);
  std::fflush(stdout);
}

void print_growth(const std::string& name, const SearchGrowth& g) {
  fmt::print("{:<24} {:>9} {:>9} {:>9} | {:>9} {:>9}\n", name, number_or_dash(g.build.n), number_or_dash(g.query.n),
             number_or_dash(g.bytes.n), number_or_dash(g.build.n_log_n), number_or_dash(g.query.n_log_n));
}

Json row(const std::string& name, const std::string& set, const SearchTiming& t, const SearchGrowth& g) {
  return {{"name", name},
          {"set", set},
          {"particles", std::lround(t.points)},
          {"neighbours", t.neighbours},
          {"build_s", t.build},
          {"query_s", t.query},
          {"bytes", std::llround(t.bytes)},
          {"exponent_build", number_or_null(g.build.n)},
          {"exponent_query", number_or_null(g.query.n)},
          {"exponent_bytes", number_or_null(g.bytes.n)},
          {"exponent_build_n_log_n", number_or_null(g.build.n_log_n)},
          {"exponent_query_n_log_n", number_or_null(g.query.n_log_n)},
          {"threads", 1},
          {"repeats", t.repeats},
          {"hardware", bench_hardware()},
          {"version", program_version()}};
}

std::vector<std::string> search_names() {
  std::vector<std::string> names;
  for (const Info& info : search_infos()) names.emplace_back(info.name);
  return names;
}

BenchSearchOptions filled(BenchSearchOptions options) {
  if (options.searches.empty()) options.searches = search_names();
  if (options.sets.empty()) options.sets.assign(search_set_names.begin(), search_set_names.end());
  if (options.particles.empty() && options.quick) options.particles = {2000, 4000, 8000};
  if (options.particles.empty()) options.particles = {8000, 16000, 32000, 64000, 125000, 250000, 500000, 1000000};
  std::ranges::sort(options.particles);
  if (options.repeats == 0) options.repeats = options.quick ? fewest_repeats : 5;
  return options;
}

/// All searches on one kind of set, size by size: what slows the machine down for a while then slows all of them.
void bench_set(const BenchSearchOptions& options, const std::string& set_name, Json& rows) {
  const SearchSetKind kind{static_cast<int>(std::ranges::find(search_set_names, set_name) - search_set_names.begin())};
  std::vector<std::vector<SearchTiming>> timings(options.searches.size());
  if (!options.json)
    fmt::print(
        "\n{}\n{:<24} {:>9} {:>10} {:>10} {:>10} {:>9} {:>9} {:>9}\n{:<24} {:>9} {:>10} {:>10} {:>10} {:>9} "
        "{:>9} {:>9}\n",
        set_name, "", "", "", "build", "query", "build", "query", "", "search", "points", "neighbours", "s", "s",
        "ns/point", "ns/point", "B/point");
  for (const int particles : options.particles) {
    const SearchSet set = make_search_set(kind, particles);
    for (std::size_t k = 0; k < options.searches.size(); ++k) {
      if (expected_seconds(timings[k], static_cast<double>(set.points.size())) > longest_seconds) continue;
      timings[k].push_back(time_search(options.searches[k], set, options.repeats));
      if (!options.json) print_timing(options.searches[k], timings[k].back());
    }
  }
  if (!options.json)
    fmt::print("\n{}: exponents of growth | with n, and with n log n\n{:<24} {:>9} {:>9} {:>9} | {:>9} {:>9}\n",
               set_name, "search", "build", "query", "bytes", "build", "query");
  for (std::size_t k = 0; k < options.searches.size(); ++k) {
    const SearchGrowth growth = growth_of(timings[k]);
    if (!options.json) print_growth(options.searches[k], growth);
    for (const auto& timing : timings[k]) rows.push_back(row(options.searches[k], set_name, timing, growth));
  }
}

}  // namespace

CLI::App* add_bench_search(CLI::App& bench, BenchSearchOptions& options) {
  auto* command = bench.add_subcommand("search", "time the neighbour searches against the number of points");
  command->add_option("--particles", options.particles, "about how many; one or several numbers")
      ->check(CLI::Range(100, 100000000))
      ->delimiter(',');
  command->add_option("--search", options.searches, "which; default: all")
      ->check(CLI::IsMember(search_names()))
      ->delimiter(',');
  command->add_option("--set", options.sets, "of points; default: both")
      ->check(CLI::IsMember(std::vector<std::string>(search_set_names.begin(), search_set_names.end())))
      ->delimiter(',');
  command->add_option("--repeats", options.repeats, "of which the median counts; three at least")
      ->check(CLI::Range(fewest_repeats, 1000));
  command->add_flag("--quick", options.quick, "few points, a few seconds");
  command->add_flag("--json", options.json, "an array of objects");
  return command;
}

int run_bench_search(const BenchSearchOptions& given) {
  const BenchSearchOptions options = filled(given);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  Json rows = Json::array();
  if (!options.json) fmt::print("{}; one thread, medians of up to {} repeats\n", bench_hardware(), options.repeats);
  for (const auto& set : options.sets) bench_set(options, set, rows);
  if (options.json) fmt::print("{}", to_text(rows));
  omp_set_num_threads(threads);
  return 0;
}

}  // namespace undine
