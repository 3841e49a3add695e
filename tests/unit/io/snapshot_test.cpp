#include "undine/io/snapshot.hpp"

#include <nlohmann/json.hpp>

#include "io_test.hpp"
#include "undine/io/hdf5_file.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

using test::error_of;
using test::read_bytes;
using test::sample_frame;
using test::TemporaryFolder;
using test::write_bytes;

void expect_same(const OwnedFrame& read, const OwnedFrame& written, double tolerance) {
  EXPECT_EQ(read.time, written.time);
  EXPECT_EQ(read.step, written.step);
  EXPECT_EQ(read.dimensions, written.dimensions);
  ASSERT_EQ(read.particles, written.particles);
  ASSERT_EQ(read.columns.size(), written.columns.size());
  for (const OwnedColumn& column : written.columns) {
    const OwnedColumn* found = read.find(column.name);
    ASSERT_NE(found, nullptr) << column.name;
    EXPECT_EQ(found->unit, column.unit);
    EXPECT_EQ(found->components, column.components);
    ASSERT_EQ(found->data.size(), column.data.size());
    const double limit = column.name == written.position ? 0 : tolerance;
    for (std::size_t i = 0; i < column.data.size(); ++i) EXPECT_NEAR(found->data[i], column.data[i], limit);
  }
  ASSERT_EQ(read.integers.size(), written.integers.size());
  for (std::size_t k = 0; k < read.integers.size(); ++k) {
    EXPECT_EQ(read.integers[k].name, written.integers[k].name);
    EXPECT_EQ(read.integers[k].data, written.integers[k].data);
  }
}

class Snapshot : public testing::TestWithParam<int> {};

TEST_P(Snapshot, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  for (const std::size_t particles : {0, 1, 10, 3000}) {
    const OwnedFrame frame = sample_frame(particles, GetParam());
    write_snapshot(folder / "a.vtkhdf", frame.view());
    expect_same(read_snapshot(folder / "a.vtkhdf"), frame, 3e-8);
    write_snapshot(folder / "a.vtkhdf", frame.view(), {.fields = Precision::double_precision, .compression = 0});
    expect_same(read_snapshot(folder / "a.vtkhdf"), frame, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.vtkhdf.tmp"));
  }
}

TEST_P(Snapshot, PadsVectorsForVtk) {
  const TemporaryFolder folder;
  const OwnedFrame frame = sample_frame(5, GetParam());
  write_snapshot(folder / "a.vtkhdf", frame.view());
  const Hdf5File file = Hdf5File::open(folder / "a.vtkhdf");
  EXPECT_EQ(file.extent("VTKHDF/Points"), (Hdf5Extent{5, 3}));
  const bool line = GetParam() == 1;
  EXPECT_EQ(file.extent("VTKHDF/PointData/v"), (Hdf5Extent{5, line ? 0u : 3u}));
  EXPECT_EQ(file.extent("VTKHDF/PointData/stress"), (Hdf5Extent{5, line ? 0u : 9u}));
  EXPECT_EQ(file.read_attribute_text("VTKHDF", "Type"), "UnstructuredGrid");
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Snapshot, testing::Values(1, 2, 3));

TEST(Snapshot, IsTheSameFileForTheSameParticles) {
  const TemporaryFolder folder;
  const OwnedFrame frame = sample_frame(500, 2);
  write_snapshot(folder / "a.vtkhdf", frame.view());
  write_snapshot(folder / "b.vtkhdf", frame.view());
  EXPECT_EQ(read_bytes(folder / "a.vtkhdf"), read_bytes(folder / "b.vtkhdf"));
}

TEST(Snapshot, RefusesFramesThatContradictThemselves) {
  const TemporaryFolder folder;
  const OwnedFrame good = sample_frame(3, 2);
  const auto refused = [&](auto change) {
    Frame frame = good.view();
    change(frame);
    return !error_of([&] { write_snapshot(folder / "a.vtkhdf", frame); }).empty();
  };
  EXPECT_TRUE(refused([](Frame& f) { f.dimensions = 4; }));
  EXPECT_TRUE(refused([](Frame& f) { f.position = "y"; }));
  EXPECT_TRUE(refused([](Frame& f) { f.columns[0].data = nullptr; }));
  EXPECT_TRUE(refused([](Frame& f) { f.columns[0].name = "a/b"; }));
  EXPECT_TRUE(refused([](Frame& f) { f.columns[0].name = "v"; }));
  EXPECT_TRUE(refused([](Frame& f) { f.integers[0].name = "v"; }));
  EXPECT_TRUE(refused([](Frame& f) { f.columns[1].components = 3; }));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Snapshot, NeverCrashesOnDamage) {
  const TemporaryFolder folder;
  write_snapshot(folder / "a.vtkhdf", sample_frame(4, 2).view());
  const std::string bytes = read_bytes(folder / "a.vtkhdf");
  for (std::size_t size = 0; size < bytes.size(); size += 61) {
    write_bytes(folder / "cut.vtkhdf", bytes.substr(0, size));
    EXPECT_THROW(read_snapshot(folder / "cut.vtkhdf"), InputError) << size;
  }
  for (std::size_t at = 0; at < bytes.size(); at += 13) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0xff);
    write_bytes(folder / "changed.vtkhdf", changed);
    error_of([&] { read_snapshot(folder / "changed.vtkhdf"); });  // may go unseen, may not crash
  }
  EXPECT_THROW(read_snapshot(folder / "missing.vtkhdf"), InputError);
}

TEST(Snapshot, RefusesOtherHdf5Files) {
  const TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  file.write<double>("a", {1});
  file.close();
  EXPECT_NE(error_of([&] { read_snapshot(folder / "a.h5"); }).find("VTKHDF"), std::string::npos);
}

TEST(SeriesFile, ListsSnapshotsWithTheirTimes) {
  const TemporaryFolder folder;
  SeriesFile series = SeriesFile::create(folder / "run.vtkhdf.series");
  series.add("run_0000.vtkhdf", 0);
  series.add("run_0001.vtkhdf", 0.1);
  series.add("run_0002.vtkhdf", 0.2);
  const Json json = read_json(folder / "run.vtkhdf.series");
  EXPECT_EQ(json["file-series-version"], "1.0");
  ASSERT_EQ(json["files"].size(), 3u);
  EXPECT_EQ(json["files"][1]["name"], "run_0001.vtkhdf");
  EXPECT_EQ(json["files"][1]["time"], 0.1);

  SeriesFile resumed = SeriesFile::resume(folder / "run.vtkhdf.series", 0.1);
  EXPECT_EQ(resumed.size(), 2u);
  resumed.add("run_0002.vtkhdf", 0.25);
  EXPECT_EQ(read_json(folder / "run.vtkhdf.series")["files"][2]["time"], 0.25);
  EXPECT_EQ(SeriesFile::resume(folder / "new.vtkhdf.series", 1).size(), 0u);
  write_bytes(folder / "bad.vtkhdf.series", "{\"files\": [\n{\"name\": 3}]}");
  EXPECT_THROW(SeriesFile::resume(folder / "bad.vtkhdf.series", 1), InputError);
  write_bytes(folder / "bad.vtkhdf.series", "{\n\"files\": [");
  EXPECT_NE(error_of([&] { SeriesFile::resume(folder / "bad.vtkhdf.series", 1); }).find(":2:"), std::string::npos);
}

}  // namespace
}  // namespace undine

// HDF5 1.10 loses a little memory whenever it finds a file damaged, and fontconfig some of what it reads; the leak
// checker, where there is one, asks here.
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5\nleak:libfontconfig"; }
// NOLINTEND(bugprone-reserved-identifier)
