#include "undine/io/case/case_value.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "undine/core/nearest.hpp"

namespace undine {
namespace {

std::string key_of(const Value& value) { return value.name.substr(0, value.name.find('[')); }

double finite(const Value& value, double number) {
  if (!std::isfinite(number))
    value.refuse(fmt::format("'{}' is not a finite number", value.name), {},
                 "give a number: nan and inf are not allowed");
  return number;
}

Expression parsed(const Value& value, const Expression::Constants& constants, const Expression::Variables& variables) {
  if (const auto number = bare(value)) return Expression(*number);
  const auto* string = value.node.as_string();
  if (!string) value.wrong_type("a number or a formula", "\"0.1 * sin(2 * pi * x)\"");
  try {
    return Expression::parse(string->get(), constants, variables);
  } catch (const InputError& error) {
    value.refuse(fmt::format("'{}': {}", value.name, error.parts().what), error.parts().why, error.parts().fix);
  }
}

}  // namespace

void Value::refuse(std::string what, std::string why, std::string fix) const {
  if (why.empty() && !table.empty()) why = placed(table);
  throw InputError(
      {.what = std::move(what), .where = state.where(node.source()), .why = std::move(why), .fix = std::move(fix)});
}

void Value::wrong_type(std::string_view wanted, std::string_view example) const {
  refuse(fmt::format("'{}' must be {}, but is {}", name, wanted, found(node)), {},
         fmt::format("write it like {} = {}", key_of(*this), example));
}

std::optional<double> bare(const Value& value) {
  if (const auto* whole = value.node.as_integer()) return static_cast<double>(whole->get());
  if (const auto* real = value.node.as_floating_point()) return finite(value, real->get());
  return {};
}

std::string example_of(Dimension dimension) {
  if (dimension == unit::one) return "0.5";
  return fmt::format("0.5 or \"0.5 {}\"", text(dimension));
}

double as_quantity(const Value& value, Dimension dimension) {
  if (const auto number = bare(value)) return *number;
  const auto* string = value.node.as_string();
  if (!string) value.wrong_type(described(dimension), example_of(dimension));
  Quantity quantity;
  try {
    quantity = parse_quantity(string->get());
  } catch (const InputError& error) {
    value.refuse(fmt::format("'{}' is {}, but {}", value.name, described(dimension), error.parts().what),
                 error.parts().why, error.parts().fix);
  }
  if (quantity.dimension == dimension) return quantity.value;
  const bool no_unit = quantity.dimension == unit::one;
  value.refuse(fmt::format("'{}' is {}, but '{}' {}", value.name, described(dimension), string->get(),
                           no_unit ? "has no unit" : "is " + described(quantity.dimension)),
               {}, fmt::format("write it like {} = {}", key_of(value), example_of(dimension)));
}

std::int64_t as_integer(const Value& value) {
  if (const auto* whole = value.node.as_integer()) return whole->get();
  const auto number = bare(value);
  constexpr double largest = 9007199254740992.0;  // 2^53: beyond it doubles skip whole numbers
  if (!number || *number != std::floor(*number) || std::abs(*number) > largest)
    value.wrong_type("a whole number", "100");
  return static_cast<std::int64_t>(*number);
}

std::string as_text(const Value& value) {
  const auto* string = value.node.as_string();
  if (!string) value.wrong_type("a string", "\"text\"");
  return string->get();
}

std::string as_choice(const Value& value, const std::vector<std::string>& valid) {
  if (!value.node.is_string() && !valid.empty()) value.wrong_type("a name", fmt::format("\"{}\"", valid.front()));
  auto word = as_text(value);
  if (std::find(valid.begin(), valid.end(), word) != valid.end()) return word;
  const auto best = did_you_mean(word, valid);
  value.refuse(fmt::format("unknown {} '{}'", key_of(value), word), {},
               fmt::format("{}{}valid: {}", best, best.empty() ? "" : " ", listed(valid)));
}

Expression as_expression(const Value& value, const Expression::Constants& constants) {
  auto expression = parsed(value, constants, Expression::position_and_time());
  if (expression.is_constant()) finite(value, expression(0, 0, 0, 0));
  return expression;
}

Expression as_formula(const Value& value, const Expression::Variables& variables) {
  return parsed(value, {}, variables);
}

}  // namespace undine
