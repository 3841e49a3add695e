#include "undine/app/lists.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "undine/app/gauges.hpp"
#include "undine/app/watchdog/causes/catalogue.hpp"
#include "undine/approximation/catalogue.hpp"
#include "undine/backend/backend.hpp"
#include "undine/core/error.hpp"
#include "undine/core/fields.hpp"
#include "undine/integrators/catalogue.hpp"
#include "undine/kernels/catalogue.hpp"
#include "undine/materials/catalogue.hpp"
#include "undine/schemes/presets.hpp"
#include "undine/search/search.hpp"
#include "undine/terms/catalogue.hpp"
#include "undine/walls/catalogue.hpp"

namespace undine {
namespace {

using nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSubsetOf;

const std::vector<std::string> term_axes{"density",
                                         "pressure",
                                         "viscosity",
                                         "artificial_viscosity",
                                         "density_diffusion",
                                         "velocity_correction",
                                         "sums",
                                         "gas_density",
                                         "gas_pressure",
                                         "energy",
                                         "gas_viscosity",
                                         "stress",
                                         "conductivity"};

std::vector<std::string> names_in(const Axis& axis) {
  std::vector<std::string> names;
  for (const Entry& entry : axis.entries) names.push_back(entry.name);
  return names;
}

std::vector<std::string> names_in(const auto& infos) {
  std::vector<std::string> names;
  for (const auto& info : infos) names.emplace_back(info.name);
  return names;
}

std::vector<std::string> names_of_axis(std::string_view axis) { return names_in(find_axis(axis)); }

const Entry& entry(std::string_view axis, std::string_view name) {
  for (const Entry& candidate : find_axis(axis).entries)
    if (candidate.name == name) return candidate;
  throw std::out_of_range(std::string(name));
}

std::string error_of(auto&& f) {
  try {
    f();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Lists, HoldEveryEntryInTheOrderOfItsList) {
  EXPECT_EQ(names_of_axis("schemes"), presets::Presets::names());
  EXPECT_EQ(names_of_axis("kernels"), Kernels::names());
  EXPECT_THAT(terms::ContinuityForms::names(), IsSubsetOf(names_of_axis("density")));
  EXPECT_EQ(names_of_axis("pressure"), terms::PressureForms::names());
  EXPECT_EQ(names_of_axis("viscosity"), terms::ViscosityForms::names());
  EXPECT_EQ(names_of_axis("artificial_viscosity"), terms::ArtificialViscosities::names());
  EXPECT_EQ(names_of_axis("density_diffusion"), terms::DiffusionForms::names());
  EXPECT_EQ(names_of_axis("velocity_correction"), terms::VelocityCorrections::names());
  EXPECT_EQ(names_of_axis("sums"), terms::Sums::names());
  EXPECT_EQ(names_of_axis("equations_of_state"), materials::EquationsOfState::names());
  EXPECT_EQ(names_of_axis("walls"), walls::Walls::names());
  EXPECT_EQ(names_of_axis("causes"), causes::Causes::names());
  EXPECT_EQ(names_of_axis("integrators"), integrators::Integrators::names());
  EXPECT_EQ(names_of_axis("approximations"), approximation::Methods::names());
  EXPECT_EQ(names_of_axis("searches"), names_in(search_infos()));
  EXPECT_EQ(names_of_axis("gauges"), names_in(gauge_infos()));
  EXPECT_EQ(names_of_axis("fields"), names_in(all_fields));
  EXPECT_EQ(names_of_axis("backends").size(), backend_names.size());
  EXPECT_EQ(names_of_axis("precisions"), std::vector<std::string>(precision_names.begin(), precision_names.end()));
}

TEST(Lists, DensitiesAreTheContinuityFormsAndTheSummedOnes) {
  auto expected = terms::ContinuityForms::names();
  expected.insert(expected.end(), {"summation", "normalised_summation"});
  EXPECT_EQ(names_of_axis("density"), expected);
}

TEST(Lists, NamesAreUniqueWithinAnAxis) {
  std::set<std::string> axis_names;
  for (const Axis& axis : axes()) {
    EXPECT_TRUE(axis_names.insert(axis.name).second) << axis.name;
    EXPECT_FALSE(axis.title.empty() || axis.entries.empty()) << axis.name;
    std::set<std::string> names;
    for (const Entry& one : axis.entries) {
      EXPECT_TRUE(names.insert(one.name).second) << axis.name << "/" << one.name;
      EXPECT_FALSE(one.name.empty() || one.title.empty()) << axis.name << "/" << one.name;
      EXPECT_EQ(one.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos) << one.name;
      EXPECT_EQ(one.properties.size(), axis.entries.front().properties.size()) << one.name;
    }
  }
}

TEST(Lists, EveryTermHasAnEquationASourceAndFields) {
  for (const auto& axis : term_axes) {
    for (const Entry& term : find_axis(axis).entries) {
      SCOPED_TRACE(axis + "/" + term.name);
      EXPECT_FALSE(term.equation.empty());
      EXPECT_FALSE(term.citation.empty());
      EXPECT_FALSE(term.reads.empty());
      EXPECT_FALSE(term.adds.empty());
      EXPECT_THAT(term.reads, IsSubsetOf(names_of_axis("fields")));
      EXPECT_THAT(term.adds, IsSubsetOf(names_of_axis("fields")));
    }
  }
}

TEST(Lists, DefaultsLieWithinTheirRanges) {
  for (const Axis& axis : axes()) {
    for (const Entry& one : axis.entries) {
      std::set<std::string> names;
      for (const ParameterLine& parameter : one.parameters) {
        SCOPED_TRACE(axis.name + "/" + one.name + "." + parameter.name);
        EXPECT_TRUE(names.insert(parameter.name).second);
        EXPECT_GE(parameter.fallback, parameter.low);
        EXPECT_LE(parameter.fallback, parameter.high);
        EXPECT_FALSE(parameter.unit.empty() || parameter.meaning.empty());
      }
    }
  }
}

TEST(Lists, TellWhatTheStructsSay) {
  const Entry& monaghan = entry("artificial_viscosity", "monaghan");
  EXPECT_THAT(monaghan.reads, ElementsAre("m", "rho", "c", "v"));
  EXPECT_THAT(monaghan.adds, ElementsAre("acc"));
  ASSERT_EQ(monaghan.parameters.size(), 2U);
  EXPECT_EQ(monaghan.parameters[0].name, "alpha");
  EXPECT_EQ(monaghan.parameters[0].fallback, terms::ViscosityMonaghan{}.alpha);
  EXPECT_EQ(monaghan.parameters[0].range(), ">= 0");

  const Entry& wendland = entry("kernels", "wendland_c2");
  EXPECT_THAT(wendland.properties, ElementsAre(testing::Pair("kappa", "2"), testing::Pair("smoothness", "C2"),
                                               testing::Pair("positive", "yes")));
  EXPECT_EQ(entry("kernels", "gaussian").properties[1].second, "jumps");
  EXPECT_EQ(entry("fields", "rho").properties[0].second, "kg/m^3");
  EXPECT_EQ(entry("fields", "mu_cfl").properties[3].second, "max");
}

TEST(Lists, RangesReadAsAUserWouldSayThem) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto range = [](double low, double high) { return ParameterLine{"", 0, "", "", low, high}.range(); };
  EXPECT_EQ(range(-infinity, infinity), "any");
  EXPECT_EQ(range(0, infinity), ">= 0");
  EXPECT_EQ(range(1e-300, infinity), "> 0");
  EXPECT_EQ(range(-infinity, 1), "<= 1");
  EXPECT_EQ(range(0, 0.5), "0 to 0.5");
}

TEST(Lists, TextTablesAreAligned) {
  for (const Axis& axis : axes()) {
    const std::string text = list_text(axis.name);
    const std::size_t column = text.find("title");
    ASSERT_NE(column, std::string::npos);
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    for (const Entry& one : axis.entries) {
      ASSERT_TRUE(std::getline(lines, line));
      EXPECT_EQ(line.find(one.name), 0U) << line;
      EXPECT_EQ(line.substr(column, one.title.size()), one.title);
      EXPECT_NE(line.back(), ' ');
    }
    EXPECT_FALSE(std::getline(lines, line));
    EXPECT_THAT(list_axes(), HasSubstr(axis.name));
  }
}

TEST(Lists, JsonParsesAndHoldsEveryEntry) {
  for (const Axis& axis : axes()) {
    const auto list = ordered_json::parse(list_json(axis.name));
    ASSERT_TRUE(list.is_array());
    ASSERT_EQ(list.size(), axis.entries.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
      EXPECT_EQ(list[k].at("name"), axis.entries[k].name);
      for (const auto* key : {"title", "equation", "citation"}) EXPECT_TRUE(list[k].at(key).is_string()) << key;
      for (const auto* key : {"parameters", "reads", "adds"}) EXPECT_TRUE(list[k].at(key).is_array()) << key;
      EXPECT_EQ(list[k]["parameters"].size(), axis.entries[k].parameters.size());
    }
  }
  const auto epsilon = ordered_json::parse(list_json("velocity_correction")).at(0).at("parameters").at(0);
  EXPECT_EQ(epsilon.at("default"), 0.5);
  EXPECT_EQ(epsilon.at("low"), 0);
  EXPECT_EQ(epsilon.at("high"), 1);
  EXPECT_TRUE(ordered_json::parse(list_json("artificial_viscosity")).at(0).at("parameters").at(0).at("high").is_null());
}

TEST(Lists, MarkdownRowsHaveTheSameNumberOfCells) {
  for (const Axis& axis : axes()) {
    std::istringstream lines(list_markdown(axis.name));
    std::string line;
    std::size_t cells = 0;
    std::size_t rows = 0;
    for (; std::getline(lines, line); ++rows) {
      std::size_t bars = 0;
      for (std::size_t k = 0; k < line.size(); ++k) bars += line[k] == '|' && (k == 0 || line[k - 1] != '\\');
      if (rows == 0) cells = bars;
      EXPECT_EQ(bars, cells) << line;
    }
    EXPECT_EQ(rows, axis.entries.size() + 2);
  }
}

TEST(Show, FindsEveryEntryByNameAndByAxis) {
  for (const Axis& axis : axes()) {
    for (const Entry& one : axis.entries) {
      const std::string exact = show_text(axis.name + "/" + one.name);
      EXPECT_THAT(exact, HasSubstr(one.title));
      EXPECT_THAT(exact, HasSubstr(one.equation));
      EXPECT_THAT(exact, HasSubstr(one.citation));
      for (const ParameterLine& parameter : one.parameters) EXPECT_THAT(exact, HasSubstr(parameter.meaning));
      EXPECT_THAT(show_text(one.name), HasSubstr(exact));
    }
  }
}

TEST(Show, ShowsEveryEntryOfTheName) {
  const std::string both = show_text("mueller");
  EXPECT_THAT(both, HasSubstr("pressure/mueller"));
  EXPECT_THAT(both, HasSubstr("viscosity/mueller"));
  EXPECT_EQ(ordered_json::parse(show_json("mueller")).size(), 2U);
  EXPECT_EQ(ordered_json::parse(show_json("viscosity/mueller")).at(0).at("axis"), "viscosity");
}

TEST(Show, PrintsParametersWithDefaultsUnitsAndRanges) {
  EXPECT_THAT(show_text("xsph"), HasSubstr("parameter  default  unit  range   meaning"));
  EXPECT_THAT(show_text("xsph"), HasSubstr("epsilon    0.5      1     0 to 1  share of the mean that is taken over"));
}

TEST(Show, AnUnknownNameSaysTheNearestAndTheValidOnes) {
  const auto near = error_of([] { (void)show_text("wendland_c3"); });
  EXPECT_THAT(near, HasSubstr("nothing is called 'wendland_c3'"));
  EXPECT_THAT(near, HasSubstr("did you mean 'wendland_c2'?"));
  EXPECT_THAT(near, HasSubstr("cubic_spline, "));
  EXPECT_THAT(error_of([] { (void)show_text("xyzzy_plugh"); }), testing::Not(HasSubstr("did you mean")));
  const auto within = error_of([] { (void)show_text("pressure/symetric"); });
  EXPECT_THAT(within, HasSubstr("did you mean 'symmetric'?"));
  EXPECT_THAT(within, testing::Not(HasSubstr("wendland")));
  EXPECT_THAT(error_of([] { (void)show_text("kernels"); }), HasSubstr("`undine list kernels`"));
  EXPECT_THAT(error_of([] { (void)show_text(""); }), HasSubstr("nothing is called ''"));
}

TEST(Lists, AnUnknownAxisSaysTheNearestAndTheValidOnes) {
  for (const auto& wrong : {"kernel", "kernals", "kernel/wendland_c2"}) {
    const auto text = error_of([&] {
      if (std::string(wrong).find('/') == std::string::npos)
        (void)list_text(wrong);
      else
        (void)show_text(wrong);
    });
    EXPECT_THAT(text, HasSubstr("did you mean 'kernels'?")) << wrong;
    EXPECT_THAT(text, HasSubstr("integrators")) << wrong;
  }
  EXPECT_THROW((void)list_json("x"), InputError);
  EXPECT_THROW((void)list_markdown("x"), InputError);
}

TEST(Lists, DocsTablesAreUpToDate) {
  const std::string path = std::string(UNDINE_SOURCE_DIR) + "/docs/tables.md";
  std::ifstream file(path);
  ASSERT_TRUE(file) << path;
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(text.str() == docs_tables()) << "docs/tables.md is stale: undine list --markdown > docs/tables.md";
  EXPECT_EQ(text.str().find("<!-- Generated by `undine list --markdown`"), 0U);
}

}  // namespace
}  // namespace undine
