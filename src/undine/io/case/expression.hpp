#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace undine {

/// A formula of position x, y, z and time t (SI units), or of other variables by name, parsed once into a small stack
/// program and then evaluated without allocation, from any number of threads.
///
/// Operators, weakest first: < <= > >= == != (giving 0 or 1; not chained), + -, * /, unary -, ^ (also **; right to
/// left). Functions: sin cos tan asin acos atan atan2 sinh cosh tanh sqrt exp log (natural, also ln) log10 abs sign
/// floor ceil pow mod min max clamp step if. sign(0) = 0; step(a) is 0 for a < 0, else 1; mod has the sign of its
/// second argument; clamp(a, low, high); if(condition, a, b) is a where the condition is not 0; both sides are
/// evaluated. min, max, clamp, step and if pass a NaN on. Constants: pi, e, and those given by name. Arithmetic is IEEE
/// double: 1/0 is inf, and the caller checks the result.
class Expression {
 public:
  using Constants = std::map<std::string, double, std::less<>>;
  using Variables = std::vector<std::string>;  ///< names, in the order of the values that evaluate() takes

  static constexpr std::size_t longest_source = 4096;  ///< characters
  static constexpr int deepest = 64;                   ///< brackets within brackets, and values waiting on the stack
  static constexpr std::size_t most_operations = 1000;

  Expression() : Expression(0.0) {}
  Expression(double constant);  // NOLINT(google-explicit-constructor): a plain number is an expression too

  /// x, y, z, t
  static const Variables& position_and_time();

  /// @throws InputError with the column within the expression; without a location.
  static Expression parse(std::string_view source, const Constants& constants = {},
                          const Variables& variables = position_and_time());

  double operator()(double x, double y, double z, double t) const {
    const double values[]{x, y, z, t};
    return evaluate(values);
  }
  /// One value for each variable that it was parsed with.
  double evaluate(std::span<const double> variables) const;

  /// A value with its first and second derivative with respect to time.
  struct Rates {
    double value = 0, first = 0, second = 0;
  };
  /// The derivatives are those of the formula as it stands, exact to rounding. Where it has a kink or a jump (abs, min,
  /// max, clamp, if, step, comparisons, sign, floor, ceil, mod) they are those of the branch that is taken.
  Rates rates(double x, double y, double z, double t) const;

  bool is_constant() const;
  /// Whether the variable of that number occurs.
  bool uses(std::size_t variable) const;
  bool uses_position() const { return uses(0) || uses(1) || uses(2); }
  bool uses_time() const { return uses(3); }
  /// As it was written.
  const std::string& source() const { return source_; }
  /// Steps of the compiled program; parts without variables are computed while parsing.
  std::size_t operations() const { return program_.size(); }

  enum class Code : std::uint8_t;
  struct Step {
    Code code;
    double value;  ///< of a constant
  };

 private:
  std::vector<Step> program_;
  std::string source_;
};

}  // namespace undine
