#include "undine/core/fields.hpp"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>

#include <gtest/gtest.h>

namespace undine {
namespace {

using namespace field;

/// Calls f(tag) for every line of fields.def.
template <class F>
void for_each_tag(F&& f) {
#define FIELD(symbol, ...) f(field::symbol{});
#include "undine/fields.def"
#undef FIELD
}

TEST(Fields, HaveDistinctNamesAndSayWhatTheyAre) {
  std::set<std::string_view> names;
  for (const FieldInfo& info : all_fields) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_FALSE(info.unit.empty() || info.meaning.empty()) << info.name;
    EXPECT_TRUE(std::ranges::all_of(info.name, [](unsigned char c) {
      return std::islower(c) || std::isdigit(c) || c == '_';
    })) << info.name;
  }
}

TEST(Fields, TagsKnowTheirLine) {
  int next = 0;
  for_each_tag([&]<class F>(F) {
    EXPECT_EQ(F::id, next++);
    EXPECT_EQ(&F::info, &all_fields[F::id]);
  });
  EXPECT_EQ(next, FieldId::count);
}

TEST(Fields, OnlyScalarsAreJoinedByMaximum) {
  for (const FieldInfo& info : all_fields)
    if (info.join == Join::max) {
      EXPECT_EQ(info.rank, Rank::scalar) << info.name;
    }
}

TEST(Fields, ValuesHaveAsManyNumbersAsTheLineSays) {
  for_each_tag([]<class F>(F) {
    EXPECT_EQ(sizeof(typename F::template value<1, double>), F::info.components(1) * sizeof(double)) << F::info.name;
    EXPECT_EQ(sizeof(typename F::template value<2, double>), F::info.components(2) * sizeof(double)) << F::info.name;
    EXPECT_EQ(sizeof(typename F::template value<3, float>), F::info.components(3) * sizeof(float)) << F::info.name;
  });
}

TEST(Fields, RowsHoldOneValuePerFieldByName) {
  Fields<rho, acc, moment>::Row<2, double> row{};
  static_assert(std::is_same_v<decltype(row.rho), double>);
  static_assert(std::is_same_v<decltype(row.acc), Vec<2>>);
  static_assert(std::is_same_v<decltype(row.moment), Vec<2, Vec<2>>>);
  acc::of(row) = {{1, 2}};
  moment::of(row)[1] = {{3, 4}};
  EXPECT_EQ(row.acc[1], 2);
  EXPECT_EQ(row.moment[1][0], 3);
  EXPECT_EQ(row.rho, 0);
}

TEST(Fields, RowsAreMadeInTheOrderOfTheList) {
  const auto row = Fields<acc, rho>::row(Vec<2>{{1, 2}}, 3.0F);
  EXPECT_EQ(row.acc[0], 1);
  EXPECT_EQ(row.rho, 3);
  static_assert(std::is_same_v<decltype(row.rho), float>, "a made row keeps the types of its expressions");
}

TEST(Fields, UnionsNameEachFieldOnceInOrderOfFirstMention) {
  using A = Fields<m, rho>;
  using B = Fields<rho, p, m, v>;
  static_assert(std::is_same_v<Union<A, B>, Fields<m, rho, p, v>>);
  static_assert(std::is_same_v<Union<B, A>, B>);
  static_assert(std::is_same_v<Union<A>, A>);
  static_assert(std::is_same_v<Union<A, A, A>, A>);
  static_assert(std::is_same_v<Union<Fields<>, A, Fields<>>, A>);
  static_assert(std::is_same_v<Union<>, Fields<>>);
  static_assert(std::is_same_v<Union<Union<A, B>, Fields<x>>, Union<A, Union<B, Fields<x>>>>);
  static_assert(std::is_same_v<Union<Fields<m, m>>, Fields<m>>);
  EXPECT_EQ((Union<A, B>::set()), A::set() | B::set());
}

TEST(Fields, SetsHoldExactlyTheListedFields) {
  const FieldSet set = Fields<x, h>::set();
  for (int f = 0; f < FieldId::count; ++f) EXPECT_EQ(set[f], f == FieldId::x || f == FieldId::h);
  static_assert(Fields<x, h>::has<h> && !Fields<x, h>::has<rho> && !Fields<>::has<x>);
  int visited = 0;
  Fields<x, h>::for_each([&]<class F>(F) { EXPECT_EQ(F::id, visited++ == 0 ? x::id : h::id); });
  EXPECT_EQ(visited, 2);
}

}  // namespace
}  // namespace undine
