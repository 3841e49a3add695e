#pragma once
// Internal to io/case: one value of the file, turned into what was asked for.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "undine/io/case/case_state.hpp"

namespace undine {

/// A value in the file with what is needed to complain about it.
struct Value {
  const CaseState& state;
  const toml::node& node;
  std::string name;   ///< "spacing", "size[1]"
  std::string table;  ///< dotted path of its table

  [[noreturn]] void refuse(std::string what, std::string why, std::string fix) const;
  [[noreturn]] void wrong_type(std::string_view wanted, std::string_view example) const;
};

/// How a value of that dimension is written, for messages.
std::string example_of(Dimension dimension);

/// A TOML number, or nothing. This and the others throw InputError at the value's location.
std::optional<double> bare(const Value& value);
double as_quantity(const Value& value, Dimension dimension);
std::int64_t as_integer(const Value& value);
std::string as_text(const Value& value);
std::string as_choice(const Value& value, const std::vector<std::string>& valid);
Expression as_expression(const Value& value, const Expression::Constants& constants);
/// A number or a formula of those variables.
Expression as_formula(const Value& value, const Expression::Variables& variables);

}  // namespace undine
