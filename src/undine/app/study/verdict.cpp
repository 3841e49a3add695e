#include "undine/app/study/verdict.hpp"

#include <cmath>

#include <fmt/format.h>

namespace undine::study {

std::string Verdict::text() const {
  std::string all;
  for (const Rule& rule : rules)
    all += fmt::format("{}{}: {}", all.empty() ? "" : "; ", rule.when ? rule.when->source() : "otherwise", rule.says);
  return all;
}

Verdict read_verdict(const Table& table, const Expression::Variables& variables) {
  Verdict verdict{table.text("name"), {}};
  const auto rules = table.tables("rules");
  if (rules.empty())
    table.fail("rules", fmt::format("the verdict '{}' has no rules", verdict.name), {},
               "add rules = [{ when = \"leaked == 0\", says = \"tight\" }, { says = \"leaks\" }]");
  for (std::size_t k = 0; k < rules.size(); ++k) {
    Verdict::Rule rule;
    if (rules[k].has("when")) rule.when = rules[k].formula("when", variables);
    rule.says = rules[k].text("says");
    if (!rule.when && k + 1 < rules.size())
      rules[k].fail("says", "a rule without 'when' always holds", "the rules after it could never act",
                    "move it to the end, or add 'when'");
    verdict.rules.push_back(std::move(rule));
  }
  return verdict;
}

std::string judge(const Verdict& verdict, std::span<const double> values) {
  for (const Verdict::Rule& rule : verdict.rules) {
    if (!rule.when) return rule.says;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (std::isnan(values[k]) && rule.when->uses(k)) return not_measured;
    const double holds = rule.when->evaluate(values);
    if (std::isnan(holds)) return not_measured;
    if (holds != 0) return rule.says;
  }
  return {};
}

}  // namespace undine::study
