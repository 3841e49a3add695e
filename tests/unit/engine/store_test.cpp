#include "undine/engine/store.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "unit/engine/crowd.hpp"

namespace undine {
namespace {

using namespace field;

/// Gives particle i values that its id tells.
template <int N>
void mark(Store<N>& store, std::size_t i) {
  const auto id = static_cast<double>(store.ids()[i]);
  store.template get<rho>()[i] = id + 0.5;
  for (int k = 0; k < N; ++k) {
    store.template get<x>()[i][k] = 10 * id + k;
    for (int j = 0; j < N; ++j) store.template get<moment>()[i][k][j] = 100 * id + 10 * k + j;
  }
}

template <int N>
bool marked(const Store<N>& store, std::size_t i) {
  const auto id = static_cast<double>(store.ids()[i]);
  bool good = store.template get<rho>()[i] == id + 0.5;
  for (int k = 0; k < N; ++k) {
    good = good && store.template get<x>()[i][k] == 10 * id + k;
    for (int j = 0; j < N; ++j) good = good && store.template get<moment>()[i][k][j] == 100 * id + 10 * k + j;
  }
  return good;
}

// Criterion: after any mix of append, remove and permute, each particle that should be there is, once, in its group,
// with the values and the material that it was given; no id is ever used twice.
RC_GTEST_PROP(Store, ParticlesKeepTheirValues, ()) {
  constexpr int N = 2;
  test::Random random(*rc::gen::arbitrary<std::uint64_t>());
  Store<N> store;
  store.allocate(Fields<x, rho, moment>::set());
  std::map<std::int64_t, std::pair<Group, int>> expected;
  std::set<std::int64_t> used;
  for (int step = 0; step < 25; ++step) {
    const Group group = random.bits() & 1 ? Group::wall : Group::fluid;
    switch (random.bits() % 3) {
      case 0: {
        const std::size_t n = random.bits() % 6;
        const int material = static_cast<int>(random.bits() % 4);
        const std::size_t first = store.append(group, n, material);
        RC_ASSERT(first + n == store.range(group).end);
        for (std::size_t i = first; i < first + n; ++i) {
          RC_ASSERT(store.get<rho>()[i] == 0.0);
          RC_ASSERT(used.insert(store.ids()[i]).second);
          expected[store.ids()[i]] = {group, material};
          mark(store, i);
        }
        break;
      }
      case 1: {
        std::vector<char> flags(store.size());
        for (std::size_t i = 0; i < flags.size(); ++i) {
          flags[i] = random.bits() % 4 == 0;
          if (flags[i]) expected.erase(store.ids()[i]);
        }
        store.remove(flags);
        break;
      }
      default: {
        const IndexRange r = store.range(group);
        const std::vector<std::int64_t> before(store.ids().begin() + static_cast<std::ptrdiff_t>(r.begin),
                                               store.ids().begin() + static_cast<std::ptrdiff_t>(r.end));
        const auto order = random.shuffled(r.size());
        store.permute(group, order);
        for (std::size_t k = 0; k < order.size(); ++k) RC_ASSERT(store.ids()[r.begin + k] == before[order[k]]);
      }
    }
    RC_ASSERT(store.size() == expected.size());
    for (const Group g : all_groups)
      for (std::size_t i = store.range(g).begin; i < store.range(g).end; ++i) {
        RC_ASSERT(expected.at(store.ids()[i]) == std::make_pair(g, static_cast<int>(store.materials()[i])));
        RC_ASSERT(marked(store, i));
      }
  }
}

TEST(Store, HoldsOnlyTheFieldsThatWereAskedFor) {
  Store<3> store;
  store.append(Group::fluid, 5, 0);
  store.allocate(Fields<rho>::set());
  EXPECT_EQ(store.get<rho>().size(), 5U);
  EXPECT_EQ(store.get<x>().size(), 0U);
  EXPECT_TRUE(store.raw(x::id).empty());
  store.get<rho>()[2] = 7;
  store.allocate(Fields<x>::set());
  EXPECT_EQ(store.get<rho>()[2], 7) << "an allocation keeps what is there";
  EXPECT_EQ(store.raw(x::id).size(), 15U);
  EXPECT_EQ(store.fields(), (Fields<rho, x>::set()));
  EXPECT_GE(store.bytes(), 5 * (8 + 24 + 8 + 4U));
}

TEST(Store, RawAndTypedViewsAreTheSameNumbers) {
  Store<2> store;
  store.allocate(Fields<moment>::set());
  store.append(Group::wall, 3, 1);
  store.get<moment>()[2][1][0] = 4;
  EXPECT_EQ(store.raw(moment::id)[2 * 4 + 2], 4);
}

}  // namespace
}  // namespace undine
