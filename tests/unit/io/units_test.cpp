#include "undine/core/units.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"

namespace undine {
namespace {

struct Sample {
  const char* source;
  double value;
  Dimension dimension;
};

// Criterion: decimal prefixes round once, so each equals the literal in SI units bit for bit.
TEST(Units, ReadsDecimalUnitsExactly) {
  const std::vector<Sample> samples{{"0.5 m", 0.5, unit::length},
                                    {"20 ms", 20e-3, unit::time},
                                    {"1000 kg/m^3", 1000, unit::density},
                                    {"1e-3 Pa s", 1e-3, unit::dynamic_viscosity},
                                    {"26.6 m/s", 26.6, unit::velocity},
                                    {"5cm", 5e-2, unit::length},
                                    {"7 cm", 7e-2, unit::length},
                                    {"1 bar", 1e5, unit::pressure},
                                    {"3 mm/s^2", 3e-3, unit::acceleration},
                                    {"1 h", 3600, unit::time},
                                    {"1.5 min", 90, unit::time},
                                    {"72.8 mN/m", 72.8e-3, unit::surface_tension},
                                    {"2 g/cm**3", 2000, unit::density},
                                    {"3 m·s^-1", 3, unit::velocity},
                                    {"3 m*s^(-1)", 3, unit::velocity},
                                    {"1 m²/s", 1, unit::kinematic_viscosity},
                                    {"4 µm", 4e-6, unit::length},
                                    {"4 um", 4e-6, unit::length},
                                    {"2 GPa", 2e9, unit::pressure},
                                    {"50 Hz", 50, unit::frequency},
                                    {"50 1/s", 50, unit::frequency},
                                    {"50 /s", 50, unit::frequency},
                                    {"4186 J/(kg K)", 4186, unit::specific_heat},
                                    {"4186 J/kg/K", 4186, unit::specific_heat},
                                    {"2 L", 2e-3, unit::volume},
                                    {" -.5e1 ", -5, unit::one},
                                    {"+3.", 3, unit::one}};
  for (const auto& [source, value, dimension] : samples) {
    const auto quantity = parse_quantity(source);
    EXPECT_EQ(quantity.value, value) << source;
    EXPECT_EQ(quantity.dimension, dimension) << source;
  }
}

// Criterion: within one rounding (relative 3e-16) of pi/2, and a plain number.
TEST(Units, ReadsAngles) {
  for (const auto* source : {"90 deg", "90°"}) {
    EXPECT_NEAR(parse_quantity(source).value, std::numbers::pi / 2, 3e-16);
    EXPECT_EQ(parse_quantity(source).dimension, unit::one);
  }
}

// Criterion: the words of the message name the culprit or the remedy.
TEST(Units, SaysWhatWasNotUnderstood) {
  const std::vector<std::pair<const char*, const char*>> samples{{"5 Pas", "did you mean 'Pa'"},
                                                                 {"5 mts", "'mts' is not a known unit"},
                                                                 {"m", "does not begin with a number"},
                                                                 {"", "does not begin with a number"},
                                                                 {"nan", "does not begin with a number"},
                                                                 {"-inf m", "does not begin with a number"},
                                                                 {"1e999 m", "out of the range"},
                                                                 {"1e99999999999 m", "exponent is out of range"},
                                                                 {"1 kg/m s", "kg/(m s)"},
                                                                 {"1 kg/(m s", "bracket is not closed"},
                                                                 {"1 m)", "left over"},
                                                                 {"1 m^x", "whole number"},
                                                                 {"1 m^99", "whole number"},
                                                                 {"1 m/", "a unit is missing"},
                                                                 {"1 000 m", "no unit can begin"},
                                                                 {"1 m 2", "no unit can begin"},
                                                                 {"1 ((((((((((m", "nested too deeply"}};
  for (const auto& [source, words] : samples) {
    try {
      parse_quantity(source);
      ADD_FAILURE() << source;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << source << " gave " << error.what();
    }
  }
}

// Criterion: these texts, which case files and messages show.
TEST(Units, WritesDimensions) {
  EXPECT_EQ(text(unit::one), "1");
  EXPECT_EQ(text(unit::density), "kg/m^3");
  EXPECT_EQ(text(unit::acceleration), "m/s^2");
  EXPECT_EQ(text(unit::per_time), "1/s");
  EXPECT_EQ(text(unit::dynamic_viscosity), "Pa s");
  EXPECT_EQ(text(unit::gravitational), "m^3/(kg s^2)");
  EXPECT_EQ(described(unit::length), "a length (m)");
  EXPECT_EQ(described(unit::one), "a plain number");
}

// Criterion: equal bits and dimension after printing and reading back.
RC_GTEST_PROP(Units, ReadsWhatItPrints, (double value)) {
  RC_PRE(std::isfinite(value));
  const auto exponent = rc::gen::inRange(-9, 10);
  const Quantity quantity{value, {*exponent, *exponent, *exponent, *exponent}};
  const auto back = parse_quantity(text(quantity));
  RC_ASSERT(back.value == value);
  RC_ASSERT(back.dimension == quantity.dimension);
}

// Criterion: any text gives a quantity or an InputError, nothing else.
RC_GTEST_PROP(Units, GarbageOnlyThrowsInputError, ()) {
  const auto source = *rc::gen::container<std::string>(rc::gen::oneOf(
      rc::gen::element('1', 'e', '.', '-', 'm', 'k', 'g', ' ', '/', '^', '(', ')', '*'), rc::gen::arbitrary<char>()));
  try {
    RC_ASSERT(std::isfinite(parse_quantity(source).value));
  } catch (const InputError&) {
  }
}

// Criterion: one edit each by definition; a swap of neighbours counts as one, case as none.
TEST(Nearest, CountsEdits) {
  EXPECT_EQ(edit_distance("spacing", "spacng"), 1);
  EXPECT_EQ(edit_distance("spacing", "spaicng"), 1);
  EXPECT_EQ(edit_distance("Pa", "pa"), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
}

// Criterion: the obvious word, or none when nothing is close.
TEST(Nearest, FindsTheMeantWord) {
  const std::vector<std::string> valid{"wendland_c2", "cubic_spline", "gaussian", "viscosity"};
  EXPECT_EQ(nearest("cubic_splin", valid), "cubic_spline");
  EXPECT_EQ(nearest("wendlandc2", valid), "wendland_c2");
  EXPECT_EQ(nearest("visc", valid), "viscosity");
  EXPECT_EQ(nearest("zzz", valid), "");
  EXPECT_EQ(nearest("", valid), "");
  EXPECT_EQ(nearest(std::string(100000, 'a'), valid), "");
}

// Criterion: symmetric, zero for the same word, at most the longer length.
RC_GTEST_PROP(Nearest, DistanceIsBoundedAndSymmetric, (const std::string& a, const std::string& b)) {
  const int distance = edit_distance(a, b);
  RC_ASSERT(distance == edit_distance(b, a));
  RC_ASSERT(edit_distance(a, a) == 0);
  RC_ASSERT(distance <= static_cast<int>(std::max(a.size(), b.size())));
}

}  // namespace
}  // namespace undine
