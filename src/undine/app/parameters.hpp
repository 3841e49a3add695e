#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/units.hpp"
#include "undine/io/case/table.hpp"

namespace undine {

/// The dimension of a parameter's unit; "1" and "SI" (a unit that depends on other parameters) take plain numbers.
inline Dimension dimension_of(std::string_view parameter_unit) {
  return parameter_unit == "1" || parameter_unit == "SI" ? unit::one
                                                         : parse_quantity("1 " + std::string(parameter_unit)).dimension;
}

/// A number of a command line: in SI units, or with a unit of that dimension. Throws InputError.
inline double read_number(std::string_view name, const std::string& words, Dimension wanted) {
  const Quantity given = parse_quantity(words);
  if (given.dimension != wanted && given.dimension != unit::one)
    throw InputError({.what = fmt::format("{} is '{}'", name, shortened(words, 40)),
                      .why = fmt::format("it must be {}", described(wanted)),
                      .fix = "give a number in SI units, or one with a unit of that kind"});
  return given.value;
}

/// Reads the parameters of a term, an equation of state or an exact solution; the members' values are the defaults.
template <class T>
void read_parameters(const Table& table, T& owner) {
  for_each_parameter<T>([&](const auto& parameter) {
    owner.*parameter.member = table.in_range(parameter.name, dimension_of(parameter.unit),
                                             {parameter.low, parameter.high}, owner.*parameter.member);
  });
}

/// Sets one parameter from the text of a command line: a number in SI units, or one with a unit. Throws InputError.
template <class T>
void set_parameter(T& owner, std::string_view name, const std::string& value) {
  std::vector<std::string> names;
  bool found = false;
  for_each_parameter<T>([&](const auto& parameter) {
    names.emplace_back(parameter.name);
    if (parameter.name != name) return;
    found = true;
    const double given = read_number(name, value, dimension_of(parameter.unit));
    if (!(given >= parameter.low && given <= parameter.high))
      throw InputError({.what = fmt::format("'{}' is out of range", name),
                        .why = fmt::format("it is {}, and must be from {} to {}", given, parameter.low, parameter.high),
                        .fix = "choose a value in that range"});
    owner.*parameter.member = given;
  });
  if (found) return;
  const std::string guess = did_you_mean(name, names);
  throw InputError({.what = fmt::format("'{}' has no parameter '{}'", T::info.name, shortened(name, 40)),
                    .fix = fmt::format("{}{}valid: {}", guess, guess.empty() ? "" : " ", listed(names))});
}

}  // namespace undine
