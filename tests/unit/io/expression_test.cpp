#include "undine/io/case/expression.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

double evaluate(std::string_view source) { return Expression::parse(source)(2, 3, 5, 7); }

std::string message(std::string_view source, const Expression::Constants& constants = {}) {
  try {
    Expression::parse(source, constants);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Criterion: the value of the same formula in C++, bit for bit, at x, y, z, t = 2, 3, 5, 7.
TEST(Expression, EvaluatesOperatorsAndFunctions) {
  const double x = 2, y = 3, z = 5, t = 7;
  const std::vector<std::pair<const char*, double>> samples{
      {"1 + 2 * 3", 7},
      {"(1 + 2) * 3", 9},
      {"8 / 4 / 2", 1},
      {"8 - 4 - 2", 2},
      {"8 / 4 * 2", 4},
      {"8 - 4 + 2", 6},
      {"2 ^ 3 ^ 2", 512},
      {"2 ** 3", 8},
      {"-2 ^ 2", -4},
      {"2 ^ -1", 0.5},
      {"--x", x},
      {"+x - -y", x + y},
      {"x * y + z / t", x * y + z / t},
      {"x < y", 1},
      {"x >= y", 0},
      {"(x == 2) * (y != 2)", 1},
      {"1 + 1 <= 2", 1},
      {"sin(x) + cos(y) * tan(z)", std::sin(x) + std::cos(y) * std::tan(z)},
      {"atan2(x, y) + asin(x/z) - acos(x/z) + atan(x)",
       std::atan2(x, y) + std::asin(x / z) - std::acos(x / z) + std::atan(x)},
      {"sqrt(exp(log(x))) + log10(100) + ln(e)", std::sqrt(std::exp(std::log(x))) + 2 + 1},
      {"sinh(x) + cosh(x) + tanh(x)", std::sinh(x) + std::cosh(x) + std::tanh(x)},
      {"abs(-x) + floor(-1.5) + ceil(-1.5) + sign(-x)", x - 2 - 1 - 1},
      {"step(-1) + 10 * step(0) + 100 * step(x)", 110},
      {"min(z, x, y) + 10 * max(x, t, y)", 72},
      {"pow(x, y) + mod(-x, y)", 9},
      {"clamp(t, 0, z) + clamp(-t, 0, z)", 5},
      {"if(x > y, 1, if(z > y, 20, 30))", 20},
      {"if(x > 0, sqrt(x), 1 / 0)", std::sqrt(x)},
      {"2 * pi", 2 * std::numbers::pi},
      {"1.5e3 + .5", 1500.5}};
  for (const auto& [source, value] : samples) EXPECT_EQ(evaluate(source), value) << source;
}

// Criterion: IEEE arithmetic, infinite or NaN as C++ gives it.
TEST(Expression, DividesByZeroAsIeee) {
  EXPECT_EQ(evaluate("1 / (x - 2)"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(evaluate("0 / (x - 2)")));
  for (const auto* source : {"min(1, 0/0*x)", "max(0/0*x, 1)", "step(0/0*x)", "if(0/0*x, 1, 2)", "clamp(0/0*x, 0, 1)"})
    EXPECT_TRUE(std::isnan(evaluate(source))) << source;
}

// Criterion: one constant step where there is no variable, and the right flags where there is.
TEST(Expression, FoldsConstants) {
  const auto constant = Expression::parse("2 * U * sin(pi / 2)", {{"U", 3.0}});
  EXPECT_TRUE(constant.is_constant());
  EXPECT_EQ(constant.operations(), 1u);
  EXPECT_EQ(constant(0, 0, 0, 0), 6.0);
  EXPECT_TRUE(Expression::parse("t").uses_time());
  EXPECT_FALSE(Expression::parse("t").uses_position());
  EXPECT_TRUE(Expression::parse("x + 1").uses_position());
  EXPECT_TRUE(Expression(1.5).is_constant());
  EXPECT_EQ(Expression(1.5)(1, 2, 3, 4), 1.5);
  EXPECT_EQ(Expression()(1, 2, 3, 4), 0.0);
}

// Criterion: the words of the message name the column, the culprit or the remedy.
TEST(Expression, SaysWhereItIsWrong) {
  const std::vector<std::pair<std::string, const char*>> samples{{"", "column 1"},
                                                                 {"1 + ", "column 5"},
                                                                 {"1 + sine(x)", "column 5"},
                                                                 {"cosh2(x)", "did you mean 'cosh'"},
                                                                 {"1 + speed", "did you mean 'speed_0'"},
                                                                 {"sin(x", "column 4"},
                                                                 {"sin(x))", "')' without '('"},
                                                                 {"2 x", "write products with *"},
                                                                 {"26.6 m/s", "values are in SI"},
                                                                 {"0 < x < 1", "cannot be chained"},
                                                                 {"x && y", "use * for 'and'"},
                                                                 {"x = 1", "compare with =="},
                                                                 {"1,5", "decimal point"},
                                                                 {"atan2(x)", "atan2 takes 2 values, not 1"},
                                                                 {"min(x)", "two or more"},
                                                                 {"sin", "'sin' is not known here"},
                                                                 {"1e999", "out of range"},
                                                                 {"x $ y", "'$'"},
                                                                 {"\xc3\xa9", "not allowed"}};
  for (const auto& [source, words] : samples) {
    const auto got = message(source, {{"speed_0", 1.0}});
    EXPECT_NE(got.find(words), std::string::npos) << source << " gave " << got;
  }
  EXPECT_NE(message("1", {{"x", 1.0}}).find("hides"), std::string::npos);
}

// Criterion: derivatives in t within 1e-8 (first) and 1e-5 (second) of central differences, for every function; values
// to the bit.
TEST(Expression, KnowsItsRates) {
  const std::vector<const char*> samples{"3",
                                         "x + y",
                                         "t",
                                         "2 - 3 * t",
                                         "0.1 * t * t - t ^ 3",
                                         "-sin(2 * t)",
                                         "0.2 * cos(pi * t) * exp(-t / 3)",
                                         "tan(t / 9)",
                                         "asin(t / 9)",
                                         "acos(t / 9)",
                                         "atan(t - 6)",
                                         "sinh(t / 4)",
                                         "cosh(t / 4)",
                                         "tanh(t - 7.5)",
                                         "sqrt(t)",
                                         "log(t)",
                                         "ln(1 + t * t)",
                                         "log10(t)",
                                         "abs(2 - t)",
                                         "t ^ 0",
                                         "t ^ 1",
                                         "t ^ -1.5",
                                         "2 ^ t",
                                         "t ^ t",
                                         "pow(t, 0.5)",
                                         "x / t + t / (1 + t * t)",
                                         "atan2(t, 2 - t)",
                                         "atan2(sin(t), cos(t))",
                                         "mod(t * t, 4)",
                                         "min(t, 3 * t, 8)",
                                         "max(t * t, t)",
                                         "clamp(t, 0, 20)",
                                         "clamp(t, 8, 9)",
                                         "if(t > 5, t ^ 2, 0)",
                                         "if(t < 5, t ^ 2, sin(t))",
                                         "step(t - 5) * t",
                                         "sign(t) * t ^ 2",
                                         "floor(t) + t",
                                         "ceil(t) * t",
                                         "(t >= 5) * t"};
  const double t = 7.3, small = 1e-3;
  for (const auto* source : samples) {
    const auto f = Expression::parse(source);
    const auto at = [&](double moment) { return f(2, 3, 5, moment); };
    const auto rates = f.rates(2, 3, 5, t);
    EXPECT_EQ(rates.value, at(t)) << source;
    // Fourth order, so that what is compared is not the error of the difference.
    const double first = (8 * (at(t + small) - at(t - small)) - (at(t + 2 * small) - at(t - 2 * small))) / (12 * small);
    const double second =
        (16 * (at(t + small) + at(t - small)) - (at(t + 2 * small) + at(t - 2 * small)) - 30 * at(t)) /
        (12 * small * small);
    const double scale = 1 + std::abs(at(t));
    EXPECT_NEAR(rates.first, first, 1e-8 * scale * (1 + std::abs(first))) << source;
    EXPECT_NEAR(rates.second, second, 1e-5 * scale * (1 + std::abs(second))) << source;
  }
}

std::string repeated(const std::string& part, int count) {
  std::string all;
  for (int k = 0; k < count; ++k) all += part;
  return all;
}

// Criterion: 60 levels and 900 operations pass; 100 levels, over 1000 operations and over 4096 characters are refused.
TEST(Expression, IsBounded) {
  EXPECT_EQ(evaluate(repeated("(", 60) + "x" + repeated(")", 60)), 2);
  EXPECT_EQ(evaluate("x" + repeated("+x", 440)), 882);
  EXPECT_NE(message(repeated("(", 100) + "x" + repeated(")", 100)).find("deep"), std::string::npos);
  EXPECT_NE(message(repeated("-", 100) + "x").find("deep"), std::string::npos);
  EXPECT_NE(message("x" + repeated("^x", 100)).find("deep"), std::string::npos);
  EXPECT_NE(message(repeated("x+(y*(", 25) + "x" + repeated("))", 25)).find("no error"), std::string::npos);
  EXPECT_NE(message(repeated("x<(y+z*t^(", 31) + "x" + repeated("))", 31)).find("wait"), std::string::npos);
  EXPECT_NE(message("x" + repeated("+x", 600)).find("more than 1000"), std::string::npos);
  EXPECT_NE(message(std::string(5000, ' ')).find("4096"), std::string::npos);
}

// Criterion: any text gives an expression that evaluates, or an InputError, nothing else.
RC_GTEST_PROP(Expression, GarbageOnlyThrowsInputError, ()) {
  const auto words = rc::gen::container<std::vector<std::string>>(
      rc::gen::element<std::string>("x", "y", "t", "1", "2.5", "+", "-", "*", "/", "^", "(", ")", ",", "<",
                                    "==", "sin(", "min(", "if(", "clamp(", "pi", " ", "sin", "1e", "\xff", "&"));
  std::string source;
  for (const auto& word : *words) source += word;
  source += *rc::gen::arbitrary<std::string>();
  for (const auto& text : {source, source.substr(0, source.size() / 2)}) {
    try {
      const double value = Expression::parse(text)(0.5, -1, 0, 2);
      RC_ASSERT(std::isnan(value) || !std::isnan(value));
    } catch (const InputError&) {
    }
  }
}

// Criterion: a random formula of + - * and brackets equals direct evaluation bit for bit.
RC_GTEST_PROP(Expression, AgreesWithDirectEvaluation, (const std::vector<unsigned char>& choices)) {
  std::string source = "x";
  double value = 2;
  for (const auto choice : choices) {
    if (source.size() > 120) break;
    const double number = choice / 4;
    switch (choice % 4) {
      case 0:
        source = "(" + source + " + " + std::to_string(choice / 4) + ")";
        value = value + number;
        break;
      case 1:
        source = std::to_string(choice / 4) + " - (" + source + ")";
        value = number - value;
        break;
      case 2:
        source = "(" + source + ") * -y";
        value = value * -3;
        break;
      default:
        source = "max(" + source + ", z)";
        value = value > 5 ? value : 5;
    }
  }
  RC_ASSERT(evaluate(source) == value);
}

}  // namespace
}  // namespace undine
