#include "undine/io/time_series.hpp"

#include <limits>

#include "io_test.hpp"

namespace undine {
namespace {

using test::error_of;
using test::read_bytes;
using test::TemporaryFolder;
using test::write_bytes;

const std::vector<SeriesColumn> columns = {{"time", "s"}, {"front", "m"}, {"ratio"}};

void add(TimeSeries& series, std::vector<double> row) { series.add(row); }

TEST(TimeSeries, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  TimeSeries series = TimeSeries::create(folder / "a.csv", columns, {"dam break", "two\nlines"});
  EXPECT_EQ(read_bytes(folder / "a.csv"), "# dam break\n# two\n# lines\ntime [s],front [m],ratio\n");
  add(series, {0, 0.1, 1.0 / 3});
  EXPECT_EQ(read_csv(folder / "a.csv").rows, 1u);  // flushed at each row
  add(series, {0.1, std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()});
  const CsvTable table = read_csv(folder / "a.csv");
  EXPECT_EQ(table.rows, 2u);
  EXPECT_EQ(table.column("front").unit, "m");
  EXPECT_EQ(table.column("ratio").values[0], 1.0 / 3);
  EXPECT_TRUE(std::isnan(table.column("front").values[1]));
  EXPECT_EQ(table.column("ratio").values[1], -std::numeric_limits<double>::infinity());
  EXPECT_THROW(add(series, {1, 2}), Error);
}

TEST(TimeSeries, ResumesAtATime) {
  const TemporaryFolder folder;
  {
    TimeSeries series = TimeSeries::create(folder / "a.csv", columns, {"comment"});
    for (const double time : {0.0, 0.1, 0.2, 0.3}) add(series, {time, time, 1});
  }
  write_bytes(folder / "a.csv", read_bytes(folder / "a.csv") + "0.4,0.");  // the program died here
  {
    TimeSeries series = TimeSeries::resume(folder / "a.csv", columns, 0.1);
    add(series, {0.15, 7, 8});
  }
  EXPECT_EQ(read_bytes(folder / "a.csv"), "# comment\ntime [s],front [m],ratio\n0,0,1\n0.1,0.1,1\n0.15,7,8\n");
  EXPECT_THROW(TimeSeries::resume(folder / "a.csv", {{"time", "s"}}, 0.1), InputError);
  TimeSeries::resume(folder / "new.csv", columns, 0.1);
  EXPECT_EQ(read_bytes(folder / "new.csv"), "time [s],front [m],ratio\n");
}

// Criterion: a byte order mark before the first comment, as an editor may leave it, makes neither that comment nor the
// header a row.
TEST(TimeSeries, ResumesBehindAByteOrderMark) {
  const TemporaryFolder folder;
  const std::string rows = "# comment\ntime [s],front [m],ratio\n0,0,1\n";
  write_bytes(folder / "a.csv", "\xef\xbb\xbf" + rows + "0.1,0.1,1\n");
  TimeSeries::resume(folder / "a.csv", columns, 0.05);
  EXPECT_EQ(read_bytes(folder / "a.csv"), rows);
}

TEST(TimeSeries, RefusesWhatItCannotWrite) {
  const TemporaryFolder folder;
  EXPECT_THROW(TimeSeries::create(folder / "missing/a.csv", columns), Error);
  EXPECT_THROW(TimeSeries::create(folder / "a.csv", {{"a,b", ""}}), Error);
  EXPECT_THROW(TimeSeries::create(folder / "a.csv", {{"a\nb", ""}}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Csv, UnderstandsFilesFromElsewhere) {
  const CsvTable table = parse_csv(
      "\xef\xbb\xbf# Martin & Moyce (1952), fig. 3\r\n\r\n  t [-] , x/a ,note\r\n0,1,\r\n # aside\r\n +0.5 "
      ",1.2e0,nan\r\n"
      "1,1e-400,.5\r\n",
      "ref.csv");
  EXPECT_EQ(table.rows, 3u);
  EXPECT_EQ(table.column("t").unit, "-");
  EXPECT_EQ(table.column("t").values, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(table.column("x/a").values, (std::vector<double>{1, 1.2, 0}));
  EXPECT_TRUE(std::isnan(table.column("note").values[0]));
  EXPECT_TRUE(std::isnan(table.column("note").values[1]));
  EXPECT_EQ(table.find("x"), nullptr);
}

TEST(Csv, SaysWhereItIsWrong) {
  const auto error = [](const std::string& text) { return error_of([&] { parse_csv(text, "ref.csv"); }); };
  EXPECT_NE(error("# c\nt,x\n0,1\n0,1,2\n").find("ref.csv:4: this line has 3 cells"), std::string::npos);
  EXPECT_NE(error("t,x\n0, 1.5m\n").find("ref.csv:2:3: '1.5m' is not a number"), std::string::npos);
  EXPECT_NE(error("t,x\n0,1e999\n").find("not a number"), std::string::npos);
  EXPECT_NE(error("t,x\n0,+-1\n").find("not a number"), std::string::npos);
  EXPECT_NE(error("0,1\n").find("names of the columns is missing"), std::string::npos);
  EXPECT_NE(error("t,t [s]\n").find("two columns are called 't'"), std::string::npos);
  EXPECT_NE(error("t,,x\n").find("column 2 has no name"), std::string::npos);
  EXPECT_NE(error("# only a comment").find("empty"), std::string::npos);
  const CsvTable table = parse_csv("t,x\n", "ref.csv");
  EXPECT_NE(error_of([&] { table.column("y"); }).find("t, x"), std::string::npos);
  EXPECT_THROW(read_csv("/nonexistent/ref.csv"), InputError);
  EXPECT_THROW(read_csv("/"), InputError);
}

}  // namespace
}  // namespace undine
