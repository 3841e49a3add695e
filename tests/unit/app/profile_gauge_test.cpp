#include <fstream>

#include <gmock/gmock.h>

#include "undine/app/gauges/profile.hpp"
#include "undine/io/case/document.hpp"
#include "unit/io/io_test.hpp"
#include "unit/schemes/flow.hpp"

namespace undine {
namespace {

using namespace field;
using test::error_of;
using ::testing::HasSubstr;

/// Disordered particles in the unit square with v = (1 + 2 y, 0.5 x), and a published profile of two flows.
class ProfileGauge : public ::testing::Test {
 protected:
  ProfileGauge() {
    test::Random random(5);
    std::vector<Vec<2>> at;
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 20; ++j) at.push_back(Vec<2>{{(i + 0.5) * 0.05, (j + 0.5) * 0.05}} + random.vector<2>(0.01));
    auto store = test::empty_store<2>();
    test::add_particles(store, Group::fluid, at, 0.05, 0.15);
    for (std::size_t i = 0; i < store.size(); ++i)
      store.get<v>()[i] = {{1 + 2 * store.get<x>()[i][1], 0.5 * store.get<x>()[i][0]}};
    context_.domain = {{{-0.2, -0.2}}, {{1.2, 1.2}}, {false, false}};
    flow_ = std::make_unique<WeaklyCompressible<2>>(std::move(store), context_.domain, test::liquid<2>(0.15));
    std::ofstream(file_) << "# two flows\nRe,y,u\n100,0,1\n100,0.25,1.5\n400,0.25,9\n100,1,3.5\n100,0.5,\n";
  }

  std::vector<double> read(const std::string& text) const {
    const Document document = Document::parse("[g]\nfrom = [0.5, 0]\nto = [0.5, 1]\n" + text, folder_ / "case.toml");
    const gauges::Profile<2> gauge(document.root().table("g"), context_);
    document.finish();
    const auto row = gauge.read(*flow_);
    EXPECT_EQ(row.size(), gauge.columns().size());
    return row;
  }

  const std::string usual_ = "component = \"x\"\nfile = \"profile.csv\"\nplace = \"y\"\nvalue = \"u\"\n";
  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "profile.csv";
  GaugeContext<2> context_{.spacing = 0.05, .interval = 0.1};
  std::unique_ptr<WeaklyCompressible<2>> flow_;
};

// Linear fields are found exactly, at the ends of the line too: errors are those that the file was given (0, 0, 0.5).
TEST_F(ProfileGauge, MeasuresAtPublishedPlaces) {
  const auto row = read(usual_ + "where = { Re = 100 }");
  ASSERT_EQ(row.size(), 3 + 3);
  EXPECT_NEAR(row[3], 1, 1e-9);
  EXPECT_NEAR(row[4], 1.5, 1e-9);
  EXPECT_NEAR(row[5], 3, 1e-9);
  EXPECT_NEAR(row[0], std::sqrt(0.25 / 3), 1e-9);
  EXPECT_NEAR(row[1], std::sqrt(0.25 / (1 + 2.25 + 12.25)), 1e-9);
  EXPECT_NEAR(row[2], 0.5, 1e-9);
}

TEST_F(ProfileGauge, TakesOtherComponentsScalesAndLengths) {
  const auto row = read(
      "component = \"y\"\nfile = \"profile.csv\"\nplace = \"y\"\nvalue = \"u\"\nscale = 2\nlength = 2\n"
      "where = { Re = 400 }");
  ASSERT_EQ(row.size(), 3 + 1);
  EXPECT_NEAR(row[3], 0.25, 1e-9);
  EXPECT_NEAR(row[0], 18 - 0.25, 1e-9);
}

TEST_F(ProfileGauge, RefusesWhatItCannotCompare) {
  const auto error = [&](const std::string& text) { return error_of([&] { read(text); }); };
  EXPECT_THAT(error(usual_ + "where = { Re = 300 }"), HasSubstr("no such numbers"));
  EXPECT_THAT(error(usual_ + "where = { Ra = 100 }"), HasSubstr("no column 'Ra'"));
  EXPECT_THAT(error(usual_ + "length = 0.5"), HasSubstr("off the line"));
  EXPECT_THAT(error("component = \"x\"\nfile = \"profile.csv\"\nplace = \"z\"\nvalue = \"u\"\n"),
              HasSubstr("no column 'z'"));
  EXPECT_THAT(error("component = \"x\"\nfile = \"other.csv\"\nplace = \"y\"\nvalue = \"u\"\n"), HasSubstr("no file"));
}

}  // namespace
}  // namespace undine
