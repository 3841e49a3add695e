#include "undine/app/exact.hpp"

#include <gmock/gmock.h>

#include "undine/analysis/exact/catalogue.hpp"
#include "undine/io/time_series.hpp"
#include "unit/io/io_test.hpp"

namespace undine {
namespace {

using test::error_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ExactTable, HoldsWhatTheSolutionSays) {
  const CsvTable table = parse_csv(exact_table({.name = "riemann",
                                                .sets = {"p_right=0.2", "rho_right=250 g/m^3"},
                                                .from = "-0.5",
                                                .to = "50 cm",
                                                .points = 11,
                                                .time = "100 ms"}),
                                   "riemann");
  exact::Riemann s;
  s.p_right = 0.2;
  s.rho_right = 0.25;
  ASSERT_EQ(table.rows, 11U);
  EXPECT_EQ(table.columns[0].name, "x");
  EXPECT_EQ(table.columns[0].unit, "m");
  EXPECT_EQ(table.column("density").unit, "kg/m^3");
  for (std::size_t i = 0; i < 11; ++i) {
    const double place = -0.5 + 0.1 * static_cast<double>(i);
    EXPECT_NEAR(table.column("x").values[i], place, 1e-15);
    const auto values = s.at(0.1)({{table.column("x").values[i]}});
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(table.columns[k + 1].values[i], values[k]);
  }
}

TEST(ExactTable, TakesPointsOfAPlane) {
  const CsvTable table =
      parse_csv(exact_table({.name = "taylor_green", .at = {"0,0.25", "0.25,0.1 m"}, .time = "0"}), "plane");
  EXPECT_THAT(table.column("x").values, ElementsAre(0, 0.25));
  EXPECT_THAT(table.column("y").values, ElementsAre(0.25, 0.1));
  EXPECT_NEAR(table.column("velocity_x").values[0], -1, 1e-15);
}

TEST(ExactTable, EveryEntryHasAnExample) {
  for (const std::string& name : exact::ExactSolutions::names()) {
    SCOPED_TRACE(name);
    const CsvTable table = parse_csv(exact_table({.name = name}), name);
    EXPECT_TRUE(table.rows == 101 || table.rows == 1) << table.rows;
    EXPECT_GE(table.columns.size(), 2U);
  }
}

TEST(ExactTable, SaysWhatIsWrong) {
  const auto error = [](const ExactOptions& options) { return error_of([&] { exact_table(options); }); };
  EXPECT_THAT(error({.name = "sedv"}), HasSubstr("did you mean 'sedov'?"));
  EXPECT_THAT(error({.name = "noh", .sets = {"gama=2"}}), HasSubstr("did you mean 'gamma'?"));
  EXPECT_THAT(error({.name = "noh", .sets = {"gamma"}}), HasSubstr("parameter=value"));
  EXPECT_THAT(error({.name = "noh", .sets = {"dimensions=4"}}), HasSubstr("out of range"));
  EXPECT_THAT(error({.name = "noh", .sets = {"dimensions=1.5"}}), HasSubstr("whole number"));
  EXPECT_THAT(error({.name = "noh", .sets = {"density=1 Pa"}}), HasSubstr("density (kg/m^3)"));
  EXPECT_THAT(error({.name = "noh", .at = {"1,2"}}), HasSubstr("has 2 numbers"));
  EXPECT_THAT(error({.name = "taylor_green", .at = {"1"}}), HasSubstr("has 1 numbers"));
  EXPECT_THAT(error({.name = "noh", .at = {"1"}, .points = 5}), HasSubstr("exclude each other"));
  EXPECT_THAT(error({.name = "noh", .time = "-1"}), HasSubstr("negative"));
  EXPECT_THAT(error({.name = "noh", .time = "1 m"}), HasSubstr("a time"));
  EXPECT_THAT(error({.name = "drop_oscillation", .at = {"1"}}), HasSubstr("time only"));
}

}  // namespace
}  // namespace undine
