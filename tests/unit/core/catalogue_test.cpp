#include "undine/core/catalogue.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include <gtest/gtest.h>

#include "undine/core/one_of.hpp"
#include "undine/core/parameter.hpp"
#include "undine/core/value.hpp"
#include "undine/integrators/catalogue.hpp"
#include "undine/kernels/catalogue.hpp"
#include "undine/materials/catalogue.hpp"
#include "undine/search/search.hpp"
#include "undine/terms/catalogue.hpp"
#include "undine/walls/catalogue.hpp"

namespace undine {
namespace {

/// Calls f.operator()<List>(what) for every list of the program that is a Catalogue.
template <class F>
void for_each_list(F f) {
  f.template operator()<Kernels>("kernels");
  f.template operator()<terms::PressureForms>("pressure forms");
  f.template operator()<terms::ContinuityForms>("continuity forms");
  f.template operator()<terms::ViscosityForms>("viscosity forms");
  f.template operator()<terms::DiffusionForms>("diffusion forms");
  f.template operator()<terms::ArtificialViscosities>("artificial viscosities");
  f.template operator()<terms::VelocityCorrections>("velocity corrections");
  f.template operator()<terms::Sums>("sums");
  f.template operator()<materials::EquationsOfState>("equations of state");
  f.template operator()<walls::Walls>("walls");
  f.template operator()<integrators::Integrators>("integrators");
}

/// Names are lower-case words joined by underscores, distinct; title, equation and citation are there.
void expect_good_infos(const std::vector<Info>& infos) {
  std::set<std::string_view> names;
  for (const Info& info : infos) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.name.empty() || info.title.empty() || info.equation.empty() || info.citation.empty())
        << info.name;
    EXPECT_TRUE(std::ranges::all_of(info.name, [](unsigned char c) {
      return std::islower(c) || std::isdigit(c) || c == '_';
    })) << info.name;
  }
}

TEST(Catalogues, HaveDistinctNamesAndFullInfos) {
  for_each_list([]<class List>(const char* what) {
    SCOPED_TRACE(what);
    std::vector<Info> infos;
    for (int k = 0; k < List::size; ++k) infos.push_back(List::info(k));
    expect_good_infos(infos);
  });
  expect_good_infos(search_infos());
}

TEST(Catalogues, FindVisitAndListTheSameEntries) {
  for_each_list([]<class List>(const char* what) {
    SCOPED_TRACE(what);
    int next = 0;
    List::for_each([&]<class Entry>(Entry) {
      const int k = next++;
      EXPECT_EQ(List::template index<Entry>(), k);
      EXPECT_EQ(List::index_of(Entry::info.name), k);
      EXPECT_EQ(List::info(k).name, Entry::info.name);
      EXPECT_EQ(List::names()[k], Entry::info.name);
      EXPECT_EQ(List::visit(k, []<class Visited>(Visited) { return std::is_same_v<Visited, Entry>; }), true);
    });
    EXPECT_EQ(next, List::size);
    EXPECT_EQ(List::index_of("no such name"), -1);
    EXPECT_EQ(List::index_of(""), -1);
  });
}

TEST(Catalogues, DefaultsLieWithinTheBoundsOfTheirParameters) {
  for_each_list([]<class List>(const char*) {
    List::for_each([]<class Entry>(Entry entry) {
      std::set<std::string_view> names;
      for_each_parameter<Entry>([&](const auto& parameter) {
        const double value = entry.*parameter.member;
        EXPECT_TRUE(names.insert(parameter.name).second) << Entry::info.name << '.' << parameter.name;
        EXPECT_TRUE(parameter.low <= value && value <= parameter.high) << Entry::info.name << '.' << parameter.name;
        EXPECT_FALSE(parameter.unit.empty() || parameter.meaning.empty()) << Entry::info.name << '.' << parameter.name;
      });
    });
  });
}

// Two alternatives that tell which one was called, and read different fields.
struct One {
  static constexpr Info info{"one", "-", "-", "-"};
  using reads = Fields<field::m>;
  using adds = Fields<field::rho_sum>;
  double value = 1;
  auto operator()(const auto&, const auto&, const auto&) const { return adds::row(value); }
};
struct Two {
  static constexpr Info info{"two", "-", "-", "-"};
  using reads = Fields<field::m, field::p>;
  using adds = Fields<field::rho_sum>;
  double value = 2;
  auto operator()(const auto&, const auto&, const auto&) const { return adds::row(value); }
};

TEST(OneOf, IsTheTermThatWasChosen) {
  OneOf<Catalogue<One, Two>> term;
  EXPECT_EQ(term(0, 0, 0).rho_sum, 1);
  EXPECT_EQ(term.chosen_reads(), One::reads::set());
  term.choose(1);
  term.get<Two>().value = 7;
  EXPECT_EQ(term(0, 0, 0).rho_sum, 7);
  EXPECT_EQ(term.info().name, "two");
  EXPECT_EQ(term.chosen_reads(), Two::reads::set());
  EXPECT_EQ(decltype(term)::reads::set(), Two::reads::set());
  int calls = 0;
  term.with_chosen([&]<class Term>(Term& chosen) {
    ++calls;
    EXPECT_TRUE((std::is_same_v<Term, Two>));
    chosen.value = 8;
  });
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(term(0, 0, 0).rho_sum, 8);
}

}  // namespace
}  // namespace undine
