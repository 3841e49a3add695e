#pragma once
#include <cstdint>

#include "undine/io/case/expression.hpp"

namespace undine {

// clang-format off
enum class Expression::Code : std::uint8_t {
  constant, variable,
  negate, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, sqrt, exp, log, log10, abs, sign, floor, ceil, step,
  add, subtract, multiply, divide, power, less, less_equal, greater, greater_equal, equal, not_equal, atan2, mod,
  min, max, choose, clamp
};
// clang-format on

/// How many values of the stack an operation takes.
inline int arity(Expression::Code code) {
  using Code = Expression::Code;
  if (code <= Code::variable) return 0;
  if (code < Code::add) return 1;
  return code < Code::choose ? 2 : 3;
}

/// The result of an operation on its `arity` values; reads three.
double value_of(Expression::Code code, const double* values);

}  // namespace undine
