#include "undine/analysis/exact/solution.hpp"

#include <fmt/format.h>

#include "undine/core/error.hpp"

namespace undine::exact {

int whole(std::string_view name, double value, int low) {
  if (!(value >= low && value <= 1e6) || value != std::round(value))
    throw InputError({.what = fmt::format("'{}' is a whole number of at least {}", name, low),
                      .why = fmt::format("it is {}", value)});
  return static_cast<int>(value);
}

int whole_dimensions(double value, int low) {
  const int n = whole("dimensions", value, low);
  if (n > 3)
    throw InputError({.what = fmt::format("there are no solutions in {} dimensions", n), .fix = "give at most 3"});
  return n;
}

void no_solution(std::string_view solution, const char* what, const char* why, const char* fix) {
  throw InputError({.what = fmt::format("{}: {}", solution, what), .why = why, .fix = fix});
}

}  // namespace undine::exact
