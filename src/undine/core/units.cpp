#include "undine/core/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"

namespace undine {
namespace {

/// value in SI = number * factor * 10^decade
struct Scale {
  double factor = 1;
  int decade = 0;
  Dimension dimension = {};
};

struct Unit {
  std::string_view symbol;
  Scale scale;
  bool prefixes;
};

constexpr std::array<Unit, 20> units{{
    {"m", {1, 0, unit::length}, true},
    {"g", {1, -3, unit::mass}, true},
    {"t", {1, 3, unit::mass}, false},
    {"s", {1, 0, unit::time}, true},
    {"min", {60, 0, unit::time}, false},
    {"h", {3600, 0, unit::time}, false},
    {"day", {86400, 0, unit::time}, false},
    {"K", {1, 0, unit::temperature}, true},
    {"N", {1, 0, unit::force}, true},
    {"Pa", {1, 0, unit::pressure}, true},
    {"bar", {1, 5, unit::pressure}, true},
    {"J", {1, 0, unit::energy}, true},
    {"W", {1, 0, unit::power}, true},
    {"Hz", {1, 0, unit::frequency}, true},
    {"L", {1, -3, unit::volume}, true},
    {"l", {1, -3, unit::volume}, true},
    {"rad", {1, 0, unit::angle}, true},
    {"deg", {std::numbers::pi / 180, 0, unit::angle}, false},
    {"°", {std::numbers::pi / 180, 0, unit::angle}, false},
    {"1", {1, 0, unit::one}, false},
}};

constexpr std::array<std::pair<char, int>, 8> prefixes{
    {{'n', -9}, {'u', -6}, {'m', -3}, {'c', -2}, {'d', -1}, {'k', 3}, {'M', 6}, {'G', 9}}};

struct Named {
  Dimension dimension;
  std::string_view unit;  ///< empty: made from the base units
  std::string_view name;
};

constexpr std::array<Named, 26> names{{
    {unit::one, "1", "a plain number"},
    {unit::length, "", "a length"},
    {unit::mass, "", "a mass"},
    {unit::time, "", "a time"},
    {unit::temperature, "", "a temperature"},
    {unit::area, "", "an area"},
    {unit::volume, "", "a volume"},
    {unit::per_length, "", "an inverse length"},
    {unit::per_time, "", "a frequency or rate"},
    {unit::velocity, "", "a velocity"},
    {unit::acceleration, "", "an acceleration"},
    {unit::density, "", "a density"},
    {unit::force, "N", "a force"},
    {unit::pressure, "Pa", "a pressure"},
    {unit::energy, "J", "an energy or moment"},
    {unit::power, "W", "a power"},
    {unit::specific_energy, "J/kg", "a specific energy"},
    {unit::dynamic_viscosity, "Pa s", "a dynamic viscosity"},
    {unit::kinematic_viscosity, "", "a kinematic viscosity or diffusivity"},
    {unit::surface_tension, "N/m", "a surface tension or stiffness"},
    {unit::momentum, "", "a momentum"},
    {unit::moment_of_inertia, "", "a moment of inertia"},
    {unit::flow_rate, "", "a flow rate"},
    {unit::mass_flow_rate, "", "a mass flow rate"},
    {unit::specific_heat, "J/(kg K)", "a specific heat"},
    {unit::thermal_conductivity, "W/(m K)", "a thermal conductivity"},
}};

const Named* named(Dimension dimension) {
  for (const auto& entry : names)
    if (entry.dimension == dimension) return &entry;
  return nullptr;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Other ways to write the same signs, each replaced by its ASCII form.
std::string plain(std::string_view source) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 8> signs{
      {{"µ", "u"}, {"μ", "u"}, {"·", "*"}, {"⋅", "*"}, {"×", "*"}, {"²", "^2"}, {"³", "^3"}, {"−", "-"}}};
  std::string text(source);
  for (const auto& [sign, ascii] : signs)
    for (auto at = text.find(sign); at != std::string::npos; at = text.find(sign, at))
      text.replace(at, sign.size(), ascii);
  return text;
}

/// Recursive descent over one quantity.
class Reader {
 public:
  explicit Reader(std::string_view source) : source_(source), text_(plain(source)) {}

  Quantity quantity() {
    if (source_.size() > 200) fail("it is longer than 200 characters", "write one number and its unit");
    skip_spaces();
    const auto number = digits();
    skip_spaces();
    const Scale scale = at_end() ? Scale{} : product();
    if (!at_end()) fail(fmt::format("'{}' is left over after the unit", text_.substr(at_)), example);
    return {value(number, scale), scale.dimension};
  }

 private:
  static constexpr const char* example = "write a number and a unit, like \"0.5 m\" or \"1000 kg/m^3\"";

  [[noreturn]] void fail(std::string why, std::string fix) const {
    const auto shown = fmt::format("'{}'", shortened(source_, 40));
    throw InputError({.what = shown + " is not a quantity", .why = std::move(why), .fix = std::move(fix)});
  }

  bool at_end() const { return at_ == text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[at_]; }
  void skip_spaces() {
    while (peek() == ' ' || peek() == '\t') ++at_;
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  /// The number's text up to its exponent, and the exponent.
  std::pair<std::string, int> digits() {
    std::string mantissa;
    if (take('-')) {
      mantissa = "-";
    } else {
      take('+');
    }
    bool any = false;
    const auto run = [&] {
      for (; is_digit(peek()); any = true) mantissa += text_[at_++];
    };
    run();
    if (take('.')) {
      mantissa += '.';
      run();
    }
    if (!any) fail("it does not begin with a number", example);
    return {mantissa, exponent()};
  }

  int exponent() {
    if (peek() != 'e' && peek() != 'E') return 0;
    auto next = at_ + 1;
    if (next + 1 < text_.size() && text_[next] == '+' && is_digit(text_[next + 1])) ++next;
    int n = 0;
    const auto [end, error] = std::from_chars(text_.data() + next, text_.data() + text_.size(), n);
    if (error == std::errc::invalid_argument) return 0;  // the e begins the unit
    if (error != std::errc() || std::abs(n) > 9999) fail("its exponent is out of range", "use a smaller exponent");
    at_ = static_cast<std::size_t>(end - text_.data());
    return n;
  }

  double value(const std::pair<std::string, int>& number, const Scale& scale) const {
    const auto shifted = fmt::format("{}e{}", number.first, number.second + scale.decade);
    double result = 0;
    const auto error = std::from_chars(shifted.data(), shifted.data() + shifted.size(), result).ec;
    result *= scale.factor;
    if (error != std::errc() || !std::isfinite(result)) fail("it is out of the range of numbers", "check the exponent");
    return result;
  }

  Scale product() {
    if (++depth_ > 8) fail("its brackets are nested too deeply", "write the unit with fewer brackets");
    Scale all;
    bool divided = false;
    if (peek() != '/') all = factor();
    for (skip_spaces(); !at_end() && peek() != ')'; skip_spaces()) {
      const bool divide = take('/');
      if (!divide) {
        if (divided)
          fail("a product after / can be read in two ways",
               "use brackets for what is below, like kg/(m s), or two slashes");
        if (peek() == '*') ++at_;
      }
      skip_spaces();
      const auto next = factor();
      const int sign = divide ? -1 : 1;
      all = {divide ? all.factor / next.factor : all.factor * next.factor, all.decade + sign * next.decade,
             all.dimension * power(next.dimension, sign)};
      divided |= divide;
    }
    --depth_;
    return all;
  }

  Scale factor() {
    Scale base;
    if (take('(')) {
      skip_spaces();
      base = product();
      if (!take(')')) fail("a bracket is not closed", "add ')'");
    } else {
      base = symbol();
    }
    skip_spaces();
    const bool raised = take('^') || (text_.compare(at_, 2, "**") == 0 && (at_ += 2));
    if (!raised) return base;
    skip_spaces();
    const int n = whole_power();
    return {std::pow(base.factor, n), base.decade * n, power(base.dimension, n)};
  }

  int whole_power() {
    const bool bracket = take('(');
    take('+');
    int n = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), n);
    if (error != std::errc() || std::abs(n) > 12)
      fail("a power must be a whole number from -12 to 12", "write m^2 or s^-1");
    at_ = static_cast<std::size_t>(end - text_.data());
    if (bracket && !take(')')) fail("a bracket is not closed", "add ')'");
    return n;
  }

  Scale symbol() {
    const auto begin = at_;
    const std::string_view stops = " \t*/^()";
    if (peek() == '1' && text_.find_first_not_of(" \t", at_ + 1) == text_.find('/', at_)) {
      ++at_;  // 1/s
    } else {
      while (!at_end() && stops.find(text_[at_]) == stops.npos && !is_digit(text_[at_])) ++at_;
    }
    const auto word = std::string_view(text_).substr(begin, at_ - begin);
    if (word.empty())
      fail(at_end() ? "a unit is missing at its end" : fmt::format("no unit can begin with '{}'", peek()), example);
    for (const auto& known : units)
      if (known.symbol == word) return known.scale;
    for (const auto& [prefix, decade] : prefixes)
      for (const auto& known : units)
        if (known.prefixes && word.front() == prefix && word.substr(1) == known.symbol)
          return {known.scale.factor, known.scale.decade + decade, known.scale.dimension};
    unknown(word);
  }

  [[noreturn]] void unknown(std::string_view word) const {
    std::vector<std::string> bare, all;
    for (const auto& known : units) {
      if (known.symbol == "1" || known.symbol == "°") continue;
      bare.emplace_back(known.symbol);
      all.push_back(bare.back());
      if (!known.prefixes) continue;
      for (const auto& entry : prefixes) all.push_back(entry.first + bare.back());
    }
    const auto best = did_you_mean(word, all);
    fail(fmt::format("'{}' is not a known unit", word),
         fmt::format("{}{}use one of {} (prefixes n u m c d k M G)", best, best.empty() ? "" : " or ", listed(bare)));
  }

  std::string_view source_;
  std::string text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

void append(std::string& text, std::string_view symbol, int exponent) {
  if (exponent == 0) return;
  if (!text.empty()) text += ' ';
  text += symbol;
  if (exponent != 1) text += fmt::format("^{}", exponent);
}

}  // namespace

std::string text(Dimension dimension) {
  if (const auto* entry = named(dimension); entry && !entry->unit.empty()) return std::string(entry->unit);
  const std::array<std::pair<std::string_view, int>, 4> bases{
      {{"kg", dimension.kg}, {"m", dimension.m}, {"s", dimension.s}, {"K", dimension.K}}};
  std::string above, below;
  int count_below = 0;
  for (const auto& [symbol, exponent] : bases) {
    append(above, symbol, exponent > 0 ? exponent : 0);
    append(below, symbol, exponent < 0 ? -exponent : 0);
    count_below += exponent < 0;
  }
  const std::string_view over = above.empty() ? "1" : std::string_view(above);
  if (count_below == 0) return std::string(over);
  return count_below == 1 ? fmt::format("{}/{}", over, below) : fmt::format("{}/({})", over, below);
}

std::string text(const Quantity& quantity) {
  if (quantity.dimension == unit::one) return fmt::format("{}", quantity.value);
  return fmt::format("{} {}", quantity.value, text(quantity.dimension));
}

std::string described(Dimension dimension) {
  const auto* entry = named(dimension);
  if (entry && dimension == unit::one) return std::string(entry->name);
  if (entry) return fmt::format("{} ({})", entry->name, text(dimension));
  return fmt::format("a value in {}", text(dimension));
}

Quantity parse_quantity(std::string_view source) { return Reader(source).quantity(); }

}  // namespace undine
