// Formulas of case files: whatever is accepted obeys the bounds of the sandbox and evaluates.
#include "undine/io/case/expression.hpp"

#include <cmath>

#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using undine::Expression;
  using namespace undine::fuzz;
  accepted([&] {
    const auto source = text_of(data, size);
    const auto formula = Expression::parse(source, {{"H", 0.3}, {"speed", -2.0}});
    require(source.size() <= Expression::longest_source && formula.operations() <= Expression::most_operations);
    double last = 0;
    for (const double x : {0.0, -1.5, 1e300, std::nan("")}) {
      last = formula(x, 0.25, -3, 1 / (1 + x * x));
      formula.rates(x, 0.25, -3, x);
    }
    require(!formula.is_constant() || std::isnan(last) || last == formula(7, 8, 9, 10));
    const auto again = Expression::parse(formula.source(), {{"H", 0.3}, {"speed", -2.0}});
    const double before = formula(1, 2, 3, 4), after = again(1, 2, 3, 4);
    require(before == after || (std::isnan(before) && std::isnan(after)));
  });
  return 0;
}
