#pragma once
#include <limits>
#include <string_view>

namespace undine {

/// One number of a term, an equation of state or a wall that a case file may set. The reader, `undine show` and the
/// docs derive the key, its check and its help from this line; the default is the member's own initialiser.
template <class Owner>
struct Parameter {
  std::string_view name;
  double Owner::*member;
  std::string_view unit;
  std::string_view meaning;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Calls f(parameter) for each parameter of T, if it has any.
template <class T, class F>
constexpr void for_each_parameter(F&& f) {
  if constexpr (requires { T::parameters(); }) {
    for (const auto& parameter : T::parameters()) f(parameter);
  }
}

}  // namespace undine
