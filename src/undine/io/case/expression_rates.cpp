// Derivatives of formulas in time, by the rules of calculus on (value, first, second).
#include <array>
#include <cmath>
#include <limits>

#include "undine/io/case/expression_code.hpp"

namespace undine {
namespace {

using Code = Expression::Code;
using Rates = Expression::Rates;

Rates operator+(const Rates& a, const Rates& b) { return {a.value + b.value, a.first + b.first, a.second + b.second}; }
Rates operator-(const Rates& a, const Rates& b) { return {a.value - b.value, a.first - b.first, a.second - b.second}; }
Rates operator*(const Rates& a, const Rates& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2 * a.first * b.first + a.value * b.second};
}

/// f(a) from f, f' and f'' at the value of a.
Rates chain(const Rates& a, double f, double slope, double bend) {
  return {f, slope * a.first, bend * a.first * a.first + slope * a.second};
}

Rates inverse(const Rates& a) {
  const double i = 1 / a.value;
  return chain(a, i, -i * i, 2 * i * i * i);
}
Rates logarithm(const Rates& a) {
  const double i = 1 / a.value;
  return chain(a, std::log(a.value), i, -i * i);
}
Rates exponential(const Rates& a) {
  const double f = std::exp(a.value);
  return chain(a, f, f, f);
}

Rates power(const Rates& a, const Rates& b) {
  const double f = std::pow(a.value, b.value);
  if (b.first == 0 && b.second == 0) {
    const double n = b.value;  // x^0 and x^1 have no slope or bend to divide by x for
    const double slope = n == 0 ? 0 : n * std::pow(a.value, n - 1);
    const double bend = n == 0 || n == 1 ? 0 : n * (n - 1) * std::pow(a.value, n - 2);
    return chain(a, f, slope, bend);
  }
  Rates result = exponential(b * logarithm(a));
  result.value = f;
  return result;
}

Rates arc_tangent(const Rates& y, const Rates& x) {
  const double r_sq = x.value * x.value + y.value * y.value;
  const double turn = x.value * y.first - y.value * x.first;
  const double growth = 2 * (x.value * x.first + y.value * y.first);
  return {std::atan2(y.value, x.value), turn / r_sq,
          (x.value * y.second - y.value * x.second) / r_sq - turn * growth / (r_sq * r_sq)};
}

Rates unary(Code code, const Rates& a) {
  const double v = a.value;
  switch (code) {
    case Code::sin:
      return chain(a, std::sin(v), std::cos(v), -std::sin(v));
    case Code::cos:
      return chain(a, std::cos(v), -std::sin(v), -std::cos(v));
    case Code::tan: {
      const double f = std::tan(v), slope = 1 + f * f;
      return chain(a, f, slope, 2 * f * slope);
    }
    case Code::asin: {
      const double root = std::sqrt(1 - v * v);
      return chain(a, std::asin(v), 1 / root, v / (root * root * root));
    }
    case Code::acos: {
      const double root = std::sqrt(1 - v * v);
      return chain(a, std::acos(v), -1 / root, -v / (root * root * root));
    }
    case Code::atan: {
      const double slope = 1 / (1 + v * v);
      return chain(a, std::atan(v), slope, -2 * v * slope * slope);
    }
    case Code::sinh:
      return chain(a, std::sinh(v), std::cosh(v), std::sinh(v));
    case Code::cosh:
      return chain(a, std::cosh(v), std::sinh(v), std::cosh(v));
    case Code::tanh: {
      const double f = std::tanh(v), slope = 1 - f * f;
      return chain(a, f, slope, -2 * f * slope);
    }
    case Code::sqrt: {
      const double f = std::sqrt(v);
      return chain(a, f, 0.5 / f, -0.25 / (f * v));
    }
    case Code::exp:
      return exponential(a);
    case Code::log:
      return logarithm(a);
    case Code::log10:
      return logarithm(a) * Rates{1 / std::log(10.0)};
    case Code::negate:
      return Rates{} - a;
    case Code::abs:
      return v < 0 ? Rates{} - a : a;
    default:  // sign, floor, ceil, step: constant between their jumps
      return {};
  }
}

Rates apply(Code code, const Rates* v) {
  const Rates &a = v[0], &b = v[1];
  switch (code) {
    case Code::add:
      return a + b;
    case Code::subtract:
      return a - b;
    case Code::multiply:
      return a * b;
    case Code::divide:
      return a * inverse(b);
    case Code::power:
      return power(a, b);
    case Code::atan2:
      return arc_tangent(a, b);
    case Code::mod:
      return a - b * Rates{std::floor(a.value / b.value)};
    case Code::min:
      return a.value < b.value ? a : b;
    case Code::max:
      return a.value > b.value ? a : b;
    case Code::choose:
      return a.value != 0 ? b : v[2];
    case Code::clamp:
      return a.value < b.value ? b : a.value > v[2].value ? v[2] : a;
    default:
      return arity(code) == 1 ? unary(code, a) : Rates{};  // comparisons are constant between their jumps
  }
}

}  // namespace

Expression::Rates Expression::rates(double x, double y, double z, double t) const {
  std::array<Rates, deepest + 3> stack;
  Rates* top = stack.data();
  const std::array<Rates, 4> variables{{{x}, {y}, {z}, {t, 1}}};  // as position_and_time() orders them
  for (const auto& [code, constant] : program_) {
    switch (code) {
      case Code::constant:
        *top = {constant};
        break;
      case Code::variable:
        *top = variables.at(static_cast<std::size_t>(constant));
        break;
      default:
        top -= arity(code);
        // Values by the formula's own arithmetic: to the bit, and also of what has no slope.
        const double value = value_of(code, std::array{top[0].value, top[1].value, top[2].value}.data());
        *top = apply(code, top);
        top->value = value;
    }
    ++top;
  }
  return stack[0];
}

}  // namespace undine
