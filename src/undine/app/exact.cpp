#include "undine/app/exact.hpp"

#include <variant>

#include <fmt/format.h>

#include "undine/analysis/exact/catalogue.hpp"
#include "undine/app/parameters.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/atomic_file.hpp"

namespace undine {
namespace {

using exact::ExactSolutions;
using exact::Point;

constexpr int usual_points = 101, most_points = 10'000'000;

template <class Solution>
constexpr int coordinate_count = static_cast<int>(Solution::coordinates.size());

template <class Solution>
Point read_point(std::string_view option, const std::string& words) {
  Point point;
  std::size_t begin = 0;
  int count = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1, ++count) {
    end = words.find(',', begin);
    if (count < 2) point[count] = read_number(option, words.substr(begin, end - begin), unit::length);
  }
  if (count != coordinate_count<Solution>)
    throw InputError({.what = fmt::format("{} takes points of '{}', '{}' has {} numbers", option, Solution::info.name,
                                          shortened(words, 40), count),
                      .fix = coordinate_count<Solution> == 0
                                 ? "leave it out: this solution depends on time only"
                                 : fmt::format("give {} with commas between", coordinate_count<Solution>)});
  return point;
}

template <class Solution>
std::vector<Point> read_points(const ExactOptions& options) {
  std::vector<Point> points;
  if constexpr (coordinate_count<Solution> == 0) {
    if (!options.at.empty() || !options.from.empty() || !options.to.empty())
      throw InputError({.what = fmt::format("'{}' depends on time only", Solution::info.name),
                        .fix = "leave out --at, --from and --to"});
    return {Point{}};
  }
  for (const std::string& words : options.at) points.push_back(read_point<Solution>("--at", words));
  if (!points.empty() && (!options.from.empty() || !options.to.empty() || options.points > 0))
    throw InputError({.what = "--at and a line of points (--from, --to, --points) exclude each other"});
  if (!points.empty()) return points;
  const int n = options.points > 0 ? options.points : usual_points;
  if (n < 2 || n > most_points)
    throw InputError({.what = fmt::format("--points is from 2 to {}", most_points), .why = fmt::format("it is {}", n)});
  const Point from = options.from.empty() ? Solution::example.from : read_point<Solution>("--from", options.from);
  const Point to = options.to.empty() ? Solution::example.to : read_point<Solution>("--to", options.to);
  for (int k = 0; k < n; ++k) {
    const double share = k / static_cast<double>(n - 1);
    points.push_back((1 - share) * from + share * to);
  }
  return points;
}

template <class Solution>
std::string table_of(Solution solution, const ExactOptions& options) {
  for (const std::string& set : options.sets) {
    const auto equals = set.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError({.what = fmt::format("--set takes parameter=value, not '{}'", shortened(set, 40))});
    set_parameter(solution, set.substr(0, equals), set.substr(equals + 1));
  }
  const double t = options.time.empty() ? Solution::example.time : read_number("--time", options.time, unit::time);
  if (!(t >= 0)) throw InputError({.what = "--time is negative", .fix = "solutions begin at 0"});
  const std::vector<Point> points = read_points<Solution>(options);
  const auto values = solution.at(t);

  std::string table = fmt::format("# {}: {}\n# {}\n# {}\n#", Solution::info.name, Solution::info.title,
                                  Solution::info.equation, Solution::info.citation);
  for_each_parameter<Solution>([&](const auto& parameter) {
    table += fmt::format(" {} = {}{}{},", parameter.name, solution.*parameter.member, parameter.unit == "1" ? "" : " ",
                         parameter.unit == "1" ? "" : parameter.unit);
  });
  table += fmt::format(" time = {} s\n", t);
  std::string header;
  // The cavity is of unit size; every other coordinate is a length.
  for (const auto& coordinate : Solution::coordinates) header += fmt::format(",{} [m]", coordinate);
  for (const auto& field : Solution::fields)
    header += field.unit == "1" ? fmt::format(",{}", field.name) : fmt::format(",{} [{}]", field.name, field.unit);
  table += header.substr(1) + "\n";
  for (const Point& point : points) {
    std::string row;
    for (int k = 0; k < coordinate_count<Solution>; ++k) row += fmt::format(",{}", point[k]);
    for (const double value : values(point)) row += fmt::format(",{}", value + 0.0);
    table += row.substr(1) + "\n";
  }
  return table;
}

}  // namespace

std::string exact_table(const ExactOptions& options) {
  const auto names = ExactSolutions::names();
  const int index = ExactSolutions::index_of(options.name);
  if (index < 0) {
    const std::string guess = did_you_mean(options.name, names);
    throw InputError({.what = fmt::format("there is no exact solution '{}'", shortened(options.name, 40)),
                      .fix = fmt::format("{}{}valid: {}", guess, guess.empty() ? "" : " ", listed(names))});
  }
  return std::visit([&](const auto& solution) { return table_of(solution, options); }, exact::make_solution(index));
}

int run_exact(const ExactOptions& options) {
  const std::string table = exact_table(options);
  if (options.out.empty()) {
    fmt::print("{}", table);
  } else {
    write_text_atomically(options.out, table);
  }
  return 0;
}

}  // namespace undine
