#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "undine/io/case/table.hpp"

namespace undine::study {

/// A word on each member, by rules in order: the first that holds.
struct Verdict {
  struct Rule {
    std::optional<Expression> when;  ///< none: otherwise
    std::string says;
  };
  std::string name;
  std::vector<Rule> rules;

  /// "leaked == 0: tight; otherwise: leaks"
  std::string text() const;
};

/// Reads one [[verdict]].
Verdict read_verdict(const Table& table, const Expression::Variables& variables);

inline constexpr const char* not_measured = "not measured";

/// What the rules say of these values; `not_measured` if the rule whose turn it is needs a value that is not a number,
/// and nothing if no rule holds.
std::string judge(const Verdict& verdict, std::span<const double> values);

}  // namespace undine::study
