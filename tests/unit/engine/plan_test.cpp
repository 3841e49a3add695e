#include "undine/engine/plan.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "unit/engine/crowd.hpp"

namespace undine {
namespace {

using namespace field;

template <class... F>
Resources fluid() {
  return {Group::fluid, Fields<F...>::set()};
}
template <class... F>
Resources wall() {
  return {Group::wall, Fields<F...>::set()};
}

/// The names of the stages after ordering them.
std::vector<std::string> ordered(const std::vector<Stage>& stages, const Resources& given) {
  Plan plan;
  for (const auto& stage : stages) plan.add(stage);
  plan.order(given);
  std::vector<std::string> names;
  for (const auto& stage : plan.stages()) names.push_back(stage.name);
  return names;
}

std::string complaint(const std::vector<Stage>& stages, const Resources& given) {
  try {
    ordered(stages, given);
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return {};
}

using Names = std::vector<std::string>;

// Criterion: the one order that is possible, from every permutation of the stages.
TEST(Plan, OrdersStagesByWhatTheyReadAndWrite) {
  std::vector<Stage> stages{{"sum", fluid<x, m>(), fluid<rho_sum>(), {}},
                            {"density", fluid<rho_sum>(), fluid<rho>(), {}},
                            {"state", fluid<rho>(), fluid<p, c>(), {}},
                            {"force", fluid<x, m, rho, p, c>(), fluid<acc>(), {}}};
  std::ranges::sort(stages, {}, &Stage::name);
  do {
    EXPECT_EQ(ordered(stages, fluid<x, m, rho>()), (Names{"sum", "density", "state", "force"}));
  } while (std::ranges::next_permutation(stages, {}, &Stage::name).found);
}

TEST(Plan, KeepsTheGivenOrderOfStagesThatAreFree) {
  const std::vector<Stage> stages{
      {"b", fluid<x>(), fluid<p>(), {}}, {"a", fluid<x>(), fluid<c>(), {}}, {"c", fluid<x>(), fluid<drho>(), {}}};
  EXPECT_EQ(ordered(stages, fluid<x>()), (Names{"b", "a", "c"}));
}

// Criterion: what changes a field in place comes after those that only write it and before those that only read it.
TEST(Plan, PutsChangesInPlaceBetweenWritersAndReaders) {
  std::vector<Stage> stages{{"1 read", fluid<acc>(), fluid<v>(), {}},
                            {"2 change", fluid<x, acc>(), fluid<acc>(), {}},
                            {"3 write", fluid<x>(), fluid<acc>(), {}}};
  do {
    EXPECT_EQ(ordered(stages, fluid<x>()), (Names{"3 write", "2 change", "1 read"}));
  } while (std::ranges::next_permutation(stages, {}, &Stage::name).found);
}

TEST(Plan, ChangesInPlaceOfOneFieldKeepTheGivenOrder) {
  const std::vector<Stage> stages{{"gravity", fluid<acc>(), fluid<acc>(), {}},
                                  {"drag", fluid<acc>(), fluid<acc>(), {}}};
  EXPECT_EQ(ordered(stages, fluid<acc>()), (Names{"gravity", "drag"}));
}

TEST(Plan, TellsGroupsApart) {
  const std::vector<Stage> stages{{"force", fluid<p>().add(wall<p>()), fluid<acc>(), {}},
                                  {"wall state", wall<rho>(), wall<p>(), {}},
                                  {"wall density", fluid<m>(), wall<rho>(), {}}};
  EXPECT_EQ(ordered(stages, fluid<p, m>()), (Names{"wall density", "wall state", "force"}));
}

TEST(Plan, NamesTheStagesOfACycle) {
  const auto text = complaint({{"free", fluid<x>(), fluid<v>(), {}},
                               {"hen", fluid<p>(), fluid<rho>(), {}},
                               {"egg", fluid<rho>(), fluid<p>(), {}}},
                              fluid<x>());
  EXPECT_NE(text.find("hen"), std::string::npos) << text;
  EXPECT_NE(text.find("egg"), std::string::npos) << text;
  EXPECT_EQ(text.find("free"), std::string::npos) << text;
}

TEST(Plan, NamesAFieldThatNothingWrites) {
  const auto text = complaint({{"force", fluid<x, p>().add(wall<c>()), fluid<acc>(), {}}}, fluid<x>());
  EXPECT_NE(text.find("force"), std::string::npos) << text;
  EXPECT_NE(text.find("p(fluid)"), std::string::npos) << text;
  EXPECT_NE(text.find("c(wall)"), std::string::npos) << text;
  EXPECT_EQ(text.find("x(fluid)"), std::string::npos) << text;
}

TEST(Plan, KnowsWhatEarlierStagesWroteAndRunsInOrder) {
  std::string run;
  Plan plan;
  plan.add({"force", fluid<x, p>(), fluid<acc>(), [&] { run += "force "; }});
  plan.add({"state", fluid<rho>(), fluid<p>(), [&] { run += "state "; }});
  plan.order(fluid<x, rho>());
  plan.run();
  EXPECT_EQ(run, "state force ");
  const auto fresh = plan.fresh_reads();
  EXPECT_TRUE(fresh[0].empty());
  EXPECT_EQ(fresh[1].text(), "p(fluid)");
}

// Criterion: in 300 random plans that are possible by making, no stage comes before one whose result it reads.
TEST(Plan, EveryReaderOfARandomPlanComesAfterItsWriter) {
  test::Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t n = 2 + random.bits() % 10;
    std::vector<Stage> stages(n);
    for (std::size_t s = 0; s < n; ++s) {
      FieldSet read, written;
      for (std::size_t earlier = 0; earlier < s; ++earlier) read[earlier] = random.bits() % 3 == 0;
      written.set(s);
      stages[s] = {std::to_string(s), Resources(Group::fluid, read), Resources(Group::fluid, written), {}};
    }
    Plan plan;
    for (const auto k : random.shuffled(n)) plan.add(stages[k]);
    plan.order({});
    for (std::size_t s = 0; s < n; ++s)
      for (std::size_t later = s; later < n; ++later)
        ASSERT_FALSE(plan.stages()[s].reads.overlaps(plan.stages()[later].writes));
  }
}

TEST(Resources, AreSetsOfFieldsOfGroups) {
  Resources a = fluid<x, p>();
  a.add(Group::wall, Fields<p>::set());
  EXPECT_EQ(a.text(), "x(fluid), p(fluid), p(wall)");
  EXPECT_EQ(a.without(fluid<p>()).text(), "x(fluid), p(wall)");
  EXPECT_EQ(a.common(wall<p, c>()).text(), "p(wall)");
  EXPECT_EQ(a.fields(), (Fields<x, p>::set()));
  EXPECT_TRUE(Resources().empty());
  EXPECT_FALSE(a.overlaps(wall<x>()));
}

}  // namespace
}  // namespace undine
