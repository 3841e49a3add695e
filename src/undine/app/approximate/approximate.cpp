#include "undine/app/approximate/approximate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <omp.h>

#include "undine/app/approximate/files.hpp"
#include "undine/app/approximate/study.hpp"
#include "undine/app/parameters.hpp"
#include "undine/app/run/options.hpp"
#include "undine/approximation/catalogue.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/core/units.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;
using approximation::Approximation;
using approximation::Degrees;
using approximation::Status;

constexpr double most_queries = 1e8;

/// A positive number of this dimension, with or without its unit.
double amount(const std::string& option, const std::string& text, Dimension dimension) {
  const double value = read_number(option, text, dimension);
  if (!(value > 0))
    throw InputError({.what = fmt::format("{} is '{}'", option, text), .why = "it must be greater than 0"});
  return value;
}

/// The points of one group.
OwnedFrame only_group(OwnedFrame frame, int group) {
  const OwnedIntColumn* groups = frame.find_integers("group");
  if (!groups)
    throw InputError({.what = "the points have no groups",
                      .why = "--group picks by the whole-number column 'group' of a snapshot",
                      .fix = "leave --group out"});
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < frame.particles; ++i)
    if (groups->at(i) == group) kept.push_back(i);
  if (kept.empty()) throw InputError({.what = fmt::format("no point is of group {}", group)});
  for (auto& column : frame.columns) {
    std::vector<double> data;
    const auto c = static_cast<std::size_t>(column.components);
    for (const std::size_t i : kept)
      data.insert(data.end(), column.data.begin() + static_cast<std::ptrdiff_t>(i * c),
                  column.data.begin() + static_cast<std::ptrdiff_t>((i + 1) * c));
    column.data = std::move(data);
  }
  frame.integers.clear();
  frame.particles = kept.size();
  return frame;
}

const std::vector<std::string> amounts{"m", "volume", "h"};  ///< columns that are no fields unless named

std::vector<const OwnedColumn*> chosen_fields(const OwnedFrame& frame, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  std::vector<const OwnedColumn*> all, chosen;
  for (const auto& column : frame.columns) {
    if (column.name == frame.position) continue;
    known.push_back(column.name);
    if (std::ranges::count(amounts, column.name) == 0) all.push_back(&column);
  }
  for (const auto& name : names) {
    if (std::ranges::count(known, name) == 0) {
      const auto guess = did_you_mean(name, known);
      throw InputError({.what = fmt::format("the points have no field '{}'", shortened(name, 60)),
                        .fix = fmt::format("{}{}they have: {}", guess, guess.empty() ? "" : " ", listed(known))});
    }
    chosen.push_back(frame.find(name));
  }
  if (names.empty()) chosen = all;
  if (chosen.empty())
    throw InputError({.what = "the points have no fields",
                      .why = "there is no column besides coordinates, m, volume and h",
                      .fix = "add a column, or name one by --fields"});
  return chosen;
}

std::vector<double> volumes(const OwnedFrame& frame, const std::string& uniform) {
  if (!uniform.empty()) {
    constexpr Dimension by_dimensions[]{unit::length, unit::area, unit::volume};
    return std::vector<double>(frame.particles, amount("--volume", uniform, by_dimensions[frame.dimensions - 1]));
  }
  if (const auto* volume = frame.find("volume"); volume && volume->components == 1) return volume->data;
  const auto *m = frame.find("m"), *rho = frame.find("rho");
  if (!m || !rho || m->components != 1 || rho->components != 1) return {};
  std::vector<double> V(frame.particles);
  for (std::size_t i = 0; i < V.size(); ++i) V[i] = m->data[i] / rho->data[i];
  return V;
}

template <int N>
std::vector<Vec<N>> grid_nodes(const ApproximateOptions& options, const std::vector<Vec<N>>& points) {
  const auto numbers = [&](const char* option, const auto& list, bool required) {
    if (list.size() == static_cast<std::size_t>(N) || (list.empty() && !required)) return;
    throw InputError({.what = fmt::format("{} has {} numbers", option, list.size()),
                      .why = fmt::format("the points have {} dimensions", N),
                      .fix = "give one number for each axis, as in 50,20"});
  };
  numbers("--grid", options.grid, true);
  numbers("--low", options.low, false);
  numbers("--high", options.high, false);
  Vec<N> low = points.front(), high = low;
  for (const auto& x : points)
    for (int k = 0; k < N; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  double count = 1;
  for (int k = 0; k < N; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (!options.low.empty()) low[k] = options.low[at];
    if (!options.high.empty()) high[k] = options.high[at];
    if (options.grid[at] < 1)
      throw InputError({.what = fmt::format("--grid has {} nodes along {}", options.grid[at], "xyz"[k]),
                        .why = "it must have at least 1"});
    if (!(std::isfinite(low[k]) && std::isfinite(high[k]) && low[k] <= high[k]))
      throw InputError({.what = fmt::format("the grid goes from {} to {} along {}", low[k], high[k], "xyz"[k]),
                        .why = "--low must not be above --high"});
    count *= options.grid[at];
  }
  if (count > most_queries)
    throw InputError({.what = fmt::format("the grid has {:.3g} nodes", count),
                      .why = fmt::format("at most {:.0e} are allowed", most_queries)});
  std::vector<Vec<N>> nodes(static_cast<std::size_t>(count));
  for (std::size_t q = 0; q < nodes.size(); ++q) {
    std::size_t rest = q;  // x runs fastest
    for (int k = 0; k < N; ++k) {
      const auto n = static_cast<std::size_t>(options.grid[static_cast<std::size_t>(k)]);
      const double part = n == 1 ? 0.5 : static_cast<double>(rest % n) / static_cast<double>(n - 1);
      nodes[q][k] = low[k] + part * (high[k] - low[k]);
      rest /= n;
    }
  }
  return nodes;
}

template <int N>
std::vector<Vec<N>> query_points(const ApproximateOptions& options, const std::vector<Vec<N>>& points) {
  if (!options.grid.empty()) return grid_nodes(options, points);
  if (!options.low.empty() || !options.high.empty())
    throw InputError({.what = "--low and --high are of no use without --grid", .fix = "add --grid, or leave them out"});
  if (options.at.empty()) return points;
  const OwnedFrame frame = read_scattered(options.at);
  if (frame.dimensions != N)
    throw InputError({.what = fmt::format("'{}' has {} coordinates", options.at.string(), frame.dimensions),
                      .why = fmt::format("the points to approximate from have {}", N)});
  return positions<N>(frame);
}

std::string degree_text(const char* what, int degree) {
  if (degree == Degrees::not_given) return fmt::format("no {}", what);
  return degree == Degrees::none ? fmt::format("{} exact for nothing", what)
                                 : fmt::format("{} exact to degree {}", what, degree);
}

void check_out(const ApproximateOptions& options) {
  const auto ending = options.out.extension();
  if (ending != ".csv" && ending != ".vtkhdf")
    throw InputError({.what = fmt::format("--out is '{}'", options.out.string()),
                      .why = "the ending says what is written",
                      .fix = "name a file that ends in .csv or .vtkhdf"});
  std::error_code failure;
  for (const auto& input : {options.points, options.at})
    if (!input.empty() && fs::equivalent(options.out, input, failure))
      throw InputError(
          {.what = fmt::format("--out is '{}', which is also read", options.out.string()), .fix = "name another file"});
}

template <int N>
int approximate(const ApproximateOptions& options, const OwnedFrame& frame) {
  const auto sources = chosen_fields(frame, options.fields);
  const auto x = positions<N>(frame);
  const auto queries = query_points<N>(options, x);
  const int kernel = Kernels::index_of(options.kernel);
  if (kernel < 0)
    throw InputError({.what = fmt::format("there is no kernel '{}'", shortened(options.kernel, 60)),
                      .fix = did_you_mean(options.kernel, Kernels::names()) + " see `undine list kernels`"});
  if (options.support.empty())
    throw InputError({.what = "--support is missing",
                      .why = "it is the radius within which points count",
                      .fix = "give about three distances of points, as in --support \"6 cm\""});
  const double H = amount("--support", options.support, unit::length);

  std::vector<std::vector<double>> components;
  for (const OwnedColumn* source : sources)
    for (int k = 0; k < source->components; ++k) {
      components.emplace_back();
      for (std::size_t i = 0; i < frame.particles; ++i) {
        const double u = source->data[i * static_cast<std::size_t>(source->components) + k];
        if (!std::isfinite(u))
          throw InputError({.what = fmt::format("'{}' of point {} is {}", source->name, i + 1, u),
                            .why = "every value must be a finite number"});
        components.back().push_back(u);
      }
    }
  const Approximation<N> by({x, volumes(frame, options.volume)}, {.method = options.method,
                                                                  .order = options.order,
                                                                  .kernel = KernelChoice(kernel),
                                                                  .support = H,
                                                                  .condition_limit = options.condition_limit});
  const Degrees degrees = by.degrees();
  const std::string setting =
      fmt::format("{} order {}, {}, support {:g} m", options.method, by.order(), options.kernel, H);
  fmt::print("{} points in {}-D, {}\n{}, {}, {}\n", by.size(), N, setting, degree_text("value", degrees.value),
             degree_text("gradient", degrees.gradient), degree_text("Hessian", degrees.hessian));

  const auto estimates = by.evaluate(queries, {components.begin(), components.end()});
  const std::size_t good = estimates.count(Status::ok);
  std::string counts;
  double worst = 0;
  for (int s = 0; s < static_cast<int>(std::size(approximation::status_words)); ++s)
    if (const auto n = estimates.count(static_cast<Status>(s)); n > 0)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", n, approximation::status_words[s]);
  for (std::size_t q = 0; q < queries.size(); ++q)
    if (estimates.status[q] == Status::ok) worst = std::max(worst, estimates.condition[q]);
  if (good == 0)
    throw InputError({.what = "none of the query points can be approximated at",
                      .why = counts,
                      .fix = "choose a larger support, or a lower order"});
  const auto columns = write_result(
      options.out, result_frame<N>(frame, sources, queries, estimates, degrees),
      {fmt::format("{} points of {}, {}", by.size(), options.points.filename().string(), setting),
       "SI units. status: 0 ok, 1 no_neighbours, 2 too_few, 3 degenerate; where it is not 0, values are nan"});
  fmt::print("{} queries: {}; largest condition number {:.3g}\n{}: {}\n", queries.size(), counts, worst,
             options.out.string(), listed(columns));
  if (good < queries.size())
    fmt::print(stderr, "warning: {} of {} queries have a status other than ok; their values are nan\n",
               queries.size() - good, queries.size());
  return exit_ok;
}

}  // namespace

void add_approximate_options(CLI::App& command, ApproximateOptions& options) {
  const auto numbers = [&](const char* name, auto& list, const char* what) {
    command.add_option(name, list, what)->delimiter(',')->allow_extra_args(false);
  };
  command.add_option("points", options.points, "points with fields: CSV with columns x, y, z, ..., or a snapshot");
  numbers("--fields", options.fields, "columns to approximate: rho,v; all unless given");
  command.add_option("--method", options.method, "see `undine list approximations`")->capture_default_str();
  command.add_option("--order", options.order, "of the method; 1 where it has that");
  command.add_option("--kernel", options.kernel, "see `undine list kernels`")->capture_default_str();
  command.add_option("--support", options.support, "radius within which points count: 0.05, or \"5 cm\"");
  command.add_option("--volume", options.volume, "of every point; else the column volume, or m and rho");
  command.add_option("--group", options.group, "points of this group alone: 0 fluid, 1 wall");
  auto* at =
      command.add_option("--at", options.at, "query points: CSV or snapshot; the points themselves unless given");
  auto* grid = command.add_option("--grid", options.grid, "query points: nodes along each axis, as in 50,20");
  grid->delimiter(',')->allow_extra_args(false)->excludes(at);
  numbers("--low", options.low, "first node of the grid, in m; unless given, of the bounds of the points");
  numbers("--high", options.high, "last node of the grid");
  command.add_option("--condition-limit", options.condition_limit, "above it a neighbourhood is degenerate")
      ->capture_default_str();
  command.add_option("--out", options.out, "file to write, .csv or .vtkhdf; with --consistency a folder");
  command.add_option("--threads", options.threads, "threads; 0: all cores")->check(CLI::Range(0, 1024));
  command.add_flag("--consistency", options.consistency,
                   "no approximation: errors of the methods for polynomials and a smooth function");
  command
      .add_option("--set", options.sets, "of --consistency: --set method=rkpm, order, dimensions, kernel, support, ...")
      ->allow_extra_args(false);
}

int run_approximate(const ApproximateOptions& options) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  if (options.consistency) return run_consistency(options);
  if (!options.sets.empty())
    throw InputError({.what = "--set is of no use without --consistency", .fix = "add --consistency, or leave it out"});
  if (options.points.empty())
    throw InputError({.what = "the file of points is missing", .fix = "see `undine approximate --help`"});
  if (options.out.empty())
    throw InputError({.what = "--out is missing", .fix = "name the file to write, .csv or .vtkhdf"});
  check_out(options);
  OwnedFrame frame = read_scattered(options.points);
  if (options.group) frame = only_group(std::move(frame), *options.group);
  if (frame.dimensions == 1) return approximate<1>(options, frame);
  return frame.dimensions == 2 ? approximate<2>(options, frame) : approximate<3>(options, frame);
}

}  // namespace undine
