#include "undine/io/case/expression.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/case/expression_code.hpp"

namespace undine {
namespace {

using Code = Expression::Code;
using Step = Expression::Step;

constexpr int any_number = -1;
constexpr auto simpler = "write it with fewer operations and brackets, or give particles a list of values";

struct Function {
  std::string_view name;
  Code code;
  int arguments;
};

// clang-format off
constexpr std::array<Function, 26> functions{{
    {"sin", Code::sin, 1}, {"cos", Code::cos, 1}, {"tan", Code::tan, 1}, {"asin", Code::asin, 1},
    {"acos", Code::acos, 1}, {"atan", Code::atan, 1}, {"atan2", Code::atan2, 2}, {"sinh", Code::sinh, 1},
    {"cosh", Code::cosh, 1}, {"tanh", Code::tanh, 1}, {"sqrt", Code::sqrt, 1}, {"exp", Code::exp, 1},
    {"log", Code::log, 1},
    {"ln", Code::log, 1},
    {"log10", Code::log10, 1}, {"abs", Code::abs, 1}, {"sign", Code::sign, 1}, {"floor", Code::floor, 1},
    {"ceil", Code::ceil, 1}, {"step", Code::step, 1}, {"pow", Code::power, 2}, {"mod", Code::mod, 2},
    {"min", Code::min, any_number}, {"max", Code::max, any_number}, {"clamp", Code::clamp, 3}, {"if", Code::choose, 3},
}};
// clang-format on

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double number(bool truth) { return truth ? 1.0 : 0.0; }
double least(double a, double b) { return a < b || std::isnan(a) ? a : b; }
double greatest(double a, double b) { return a > b || std::isnan(a) ? a : b; }
double sign(double a) { return a > 0 ? 1.0 : a < 0 ? -1.0 : a; }
double step(double a) { return a < 0 ? 0.0 : a >= 0 ? 1.0 : a; }
double modulo(double a, double b) { return a - b * std::floor(a / b); }

}  // namespace

// clang-format off
double value_of(Expression::Code code, const double* v) {
  const double a = v[0];
  switch (code) {
    case Code::negate: return -a;
    case Code::sin: return std::sin(a);
    case Code::cos: return std::cos(a);
    case Code::tan: return std::tan(a);
    case Code::asin: return std::asin(a);
    case Code::acos: return std::acos(a);
    case Code::atan: return std::atan(a);
    case Code::sinh: return std::sinh(a);
    case Code::cosh: return std::cosh(a);
    case Code::tanh: return std::tanh(a);
    case Code::sqrt: return std::sqrt(a);
    case Code::exp: return std::exp(a);
    case Code::log: return std::log(a);
    case Code::log10: return std::log10(a);
    case Code::abs: return std::abs(a);
    case Code::sign: return sign(a);
    case Code::floor: return std::floor(a);
    case Code::ceil: return std::ceil(a);
    case Code::step: return step(a);
    case Code::add: return a + v[1];
    case Code::subtract: return a - v[1];
    case Code::multiply: return a * v[1];
    case Code::divide: return a / v[1];
    case Code::power: return std::pow(a, v[1]);
    case Code::less: return number(a < v[1]);
    case Code::less_equal: return number(a <= v[1]);
    case Code::greater: return number(a > v[1]);
    case Code::greater_equal: return number(a >= v[1]);
    case Code::equal: return number(a == v[1]);
    case Code::not_equal: return number(a != v[1]);
    case Code::atan2: return std::atan2(a, v[1]);
    case Code::mod: return modulo(a, v[1]);
    case Code::min: return least(a, v[1]);
    case Code::max: return greatest(a, v[1]);
    case Code::choose: return std::isnan(a) ? nan : a != 0 ? v[1] : v[2];
    case Code::clamp: return least(greatest(a, v[1]), v[2]);
    default: return nan;  // constants and variables are not applied
  }
}
// clang-format on

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// Recursive descent over one expression; emits the program in the order of evaluation.
class Compiler {
 public:
  Compiler(std::string_view source, const Expression::Constants& constants, const Expression::Variables& variables)
      : source_(source), constants_(constants), variables_(variables) {}

  std::vector<Step> compile() {
    if (source_.size() > Expression::longest_source)
      fail(0, fmt::format("it has {} characters; at most {} are allowed", source_.size(), Expression::longest_source),
           simpler);
    for (const auto& [name, value] : constants_) check_name(name);
    comparison();
    if (at_ < source_.size()) left_over();
    return std::move(program_);
  }

 private:
  [[noreturn]] void fail(std::size_t at, const std::string& why, std::string fix = {}) const {
    throw InputError(
        {.what = fmt::format("column {} of the expression \"{}\": {}", at + 1, shortened(source_, 80), why),
         .fix = std::move(fix)});
  }

  /// The character at the current place, for messages.
  std::string here() const {
    const bool printable = peek() >= ' ' && peek() <= '~';
    return printable ? fmt::format("'{}'", peek()) : std::string("a character that is not allowed");
  }

  [[noreturn]] void left_over() const {
    const char c = source_[at_];
    if (c == ')') fail(at_, "')' without '('");
    if (c == '&' || c == '|')
      fail(at_, fmt::format("'{}' is not an operator", c), "use * for 'and', max(a, b) for 'or'");
    if (c == '=') fail(at_, "'=' is not an operator", "compare with ==");
    if (c == ',') fail(at_, "',' outside a function", "write numbers with a decimal point");
    fail(at_, fmt::format("expected an operator, found {}", here()),
         is_letter(c) || is_digit(c) || c == '(' ? "write products with *, and no units: values are in SI" : "");
  }

  void check_name(const std::string& name) const {
    const bool taken = name == "e" || std::ranges::count(variables_, name) > 0;
    const bool function =
        std::any_of(functions.begin(), functions.end(), [&](const auto& f) { return f.name == name; });
    if (!taken && !function && name != "pi") return;
    Error::Parts parts;
    parts.what = fmt::format("the constant '{}' hides a variable or function of that name", name);
    parts.fix = "give the constant another name";
    throw InputError(std::move(parts));
  }

  char peek(std::size_t ahead = 0) const { return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0'; }
  void skip_spaces() {
    while (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r') ++at_;
  }
  /// Takes the sign and the spaces behind it, if it is next.
  bool take(std::string_view sign) {
    if (source_.substr(at_, sign.size()) != sign) return false;
    at_ += sign.size();
    skip_spaces();
    return true;
  }

  void emit(Code code, double value = 0) {
    const auto count = static_cast<std::size_t>(arity(code));
    held_ += 1 - static_cast<int>(count);
    if (held_ > Expression::deepest)
      fail(at_, fmt::format("more than {} values wait for each other", Expression::deepest), simpler);
    const auto arguments = std::span(program_).last(std::min(count, program_.size()));
    const bool known =
        count > 0 && arguments.size() == count &&
        std::all_of(arguments.begin(), arguments.end(), [](const Step& s) { return s.code == Code::constant; });
    if (known) {
      std::array<double, 3> values{};
      for (std::size_t k = 0; k < count; ++k) values[k] = arguments[k].value;
      program_.resize(program_.size() - count);
      value = value_of(code, values.data());
      code = Code::constant;
    }
    program_.push_back({code, value});
    if (program_.size() > Expression::most_operations)
      fail(at_, fmt::format("the expression has more than {} operations", Expression::most_operations), simpler);
  }

  struct Depth {
    explicit Depth(Compiler& c) : compiler(c) {
      if (++c.depth_ > Expression::deepest)
        c.fail(c.at_, fmt::format("nested more than {} deep", Expression::deepest), simpler);
    }
    ~Depth() { --compiler.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    Compiler& compiler;
  };

  std::optional<Code> take_comparison() {
    if (take("<=")) return Code::less_equal;
    if (take(">=")) return Code::greater_equal;
    if (take("==")) return Code::equal;
    if (take("!=")) return Code::not_equal;
    if (take("<")) return Code::less;
    if (take(">")) return Code::greater;
    return {};
  }

  void comparison() {
    const Depth depth(*this);
    sum();
    const auto code = take_comparison();
    if (!code) return;
    sum();
    emit(*code);
    if (const auto at = at_; take_comparison()) fail(at, "comparisons cannot be chained", "write (a < b) * (b < c)");
  }

  void sum() {
    skip_spaces();
    product();
    for (bool plus = take("+"); plus || take("-"); plus = take("+")) {
      product();
      emit(plus ? Code::add : Code::subtract);
    }
  }

  void product() {
    unary();
    for (bool times = take("*"); times || take("/"); times = take("*")) {
      unary();
      emit(times ? Code::multiply : Code::divide);
    }
  }

  void unary() {
    if (take("-")) {
      nested_unary();
      emit(Code::negate);
    } else if (take("+")) {
      nested_unary();
    } else {
      primary();
      if (take("^") || take("**")) {
        nested_unary();  // right to left, and 2^-1
        emit(Code::power);
      }
    }
  }

  void nested_unary() {
    const Depth depth(*this);
    unary();
  }

  void primary() {
    const char c = peek();
    if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return literal();
    if (is_letter(c)) return named();
    const auto open = at_;
    if (take("(")) {
      comparison();
      if (!take(")")) unclosed(open);
      return;
    }
    if (at_ == source_.size())
      fail(at_, source_.empty() ? "it is empty" : "the expression ends too early", "add a value");
    fail(at_, fmt::format("expected a number, a name or '(', found {}", here()));
  }

  [[noreturn]] void unclosed(std::size_t open) const {
    if (at_ < source_.size()) left_over();
    fail(open, "'(' is not closed", "add ')'");
  }

  void literal() {
    double value = 0;
    const auto begin = at_;
    const auto [end, error] = std::from_chars(source_.data() + at_, source_.data() + source_.size(), value);
    if (error != std::errc()) fail(begin, "the number is out of range", "check its exponent");
    at_ = static_cast<std::size_t>(end - source_.data());
    skip_spaces();
    emit(Code::constant, value);
  }

  void named() {
    const auto begin = at_;
    while (is_letter(peek()) || is_digit(peek())) ++at_;
    const auto name = source_.substr(begin, at_ - begin);
    skip_spaces();
    if (peek() == '(') return call(name, begin);
    if (const auto which = std::ranges::find(variables_, name); which != variables_.end())
      return emit(Code::variable, static_cast<double>(which - variables_.begin()));
    if (name == "pi") return emit(Code::constant, std::numbers::pi);
    if (name == "e") return emit(Code::constant, std::numbers::e);
    if (const auto found = constants_.find(name); found != constants_.end()) return emit(Code::constant, found->second);
    unknown(name, begin);
  }

  void call(std::string_view name, std::size_t begin) {
    const auto function =
        std::find_if(functions.begin(), functions.end(), [&](const auto& entry) { return entry.name == name; });
    if (function == functions.end()) {
      const bool value =
          std::ranges::count(variables_, name) > 0 || name == "pi" || name == "e" || constants_.contains(name);
      if (value) fail(begin, fmt::format("'{}' is not a function", name), "write products with *");
      unknown(name, begin);
    }
    const auto open = at_;
    take("(");
    int count = 0;
    do {
      comparison();
      ++count;
      if (function->arguments == any_number && count > 1) emit(function->code);
    } while (take(","));
    if (!take(")")) unclosed(open);
    if (function->arguments == any_number ? count < 2 : count != function->arguments)
      fail(begin,
           fmt::format("{} takes {} values, not {}", name,
                       function->arguments == any_number ? "two or more" : std::to_string(function->arguments), count));
    if (function->arguments != any_number) emit(function->code);
  }

  [[noreturn]] void unknown(std::string_view name, std::size_t begin) const {
    std::vector<std::string> names = variables_, calls;
    names.insert(names.end(), {"pi", "e"});
    for (const auto& [constant, value] : constants_) names.push_back(constant);
    for (const auto& function : functions) calls.emplace_back(function.name);
    auto all = names;
    all.insert(all.end(), calls.begin(), calls.end());
    const auto best = did_you_mean(name, all);
    fail(begin, fmt::format("'{}' is not known here", name),
         fmt::format("{}{}names: {}; functions: {}", best, best.empty() ? "" : " ", listed(names), listed(calls)));
  }

  std::string_view source_;
  const Expression::Constants& constants_;
  const Expression::Variables& variables_;
  std::vector<Step> program_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int held_ = 0;  ///< values on the stack after the program so far
};

}  // namespace

Expression::Expression(double constant) : program_{{Code::constant, constant}}, source_(fmt::format("{}", constant)) {}

const Expression::Variables& Expression::position_and_time() {
  static const Variables names{"x", "y", "z", "t"};
  return names;
}

Expression Expression::parse(std::string_view source, const Constants& constants, const Variables& variables) {
  Expression result;
  result.program_ = Compiler(source, constants, variables).compile();
  result.source_ = source;
  return result;
}

bool Expression::uses(std::size_t variable) const {
  return std::ranges::any_of(program_, [&](const Step& step) {
    return step.code == Code::variable && step.value == static_cast<double>(variable);
  });
}

bool Expression::is_constant() const {
  return std::ranges::none_of(program_, [](const Step& step) { return step.code == Code::variable; });
}

double Expression::evaluate(std::span<const double> variables) const {
  std::array<double, deepest + 3> stack;  // the three beyond let apply() read a full set of arguments anywhere
  double* top = stack.data();
  for (const auto& [code, value] : program_) {
    if (code == Code::constant) {
      *top++ = value;
    } else if (code == Code::variable) {
      *top++ = variables[static_cast<std::size_t>(value)];
    } else {
      top -= arity(code);
      *top = value_of(code, top);
      ++top;
    }
  }
  return stack[0];
}

}  // namespace undine
