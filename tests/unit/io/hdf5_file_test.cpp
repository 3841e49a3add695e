#include "undine/io/hdf5_file.hpp"

#include "io_test.hpp"

namespace undine {
namespace {

using test::error_of;
using test::read_bytes;
using test::TemporaryFolder;
using test::write_bytes;

TEST(Hdf5File, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const std::vector<double> table = {1.5, -0.0, 1e300, 4, 5, 6};
  const std::vector<std::uint8_t> bytes(100'000, 7);
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.create_group("g");
    file.write<double>("g/z_first", std::span<const double>(table), {2, 3});
    file.write<std::int64_t>("g/a_second", {1, -2, std::int64_t{1} << 60});
    file.write<std::uint8_t>("g/bytes", std::span<const std::uint8_t>(bytes), {bytes.size()}, 6);
    file.write<float>("empty", std::vector<float>{});
    file.write_text("text", "two\nlines");
    file.write_text("no text", "");
    file.write_attribute<double>("g", "time", 0.25);
    file.write_attribute("g", "name", "höhe");
    file.close();
  }
  EXPECT_LT(read_bytes(folder / "a.h5").size(), 20'000u);
  const Hdf5File file = Hdf5File::open(folder / "a.h5");
  EXPECT_EQ(file.names("g"), (std::vector<std::string>{"z_first", "a_second", "bytes"}));
  EXPECT_EQ(file.extent("g/z_first"), (Hdf5Extent{2, 3}));
  EXPECT_EQ(file.read<double>("g/z_first"), table);
  EXPECT_EQ(file.read<std::int64_t>("g/a_second"), (std::vector<std::int64_t>{1, -2, std::int64_t{1} << 60}));
  EXPECT_EQ(file.read<std::uint8_t>("g/bytes"), bytes);
  EXPECT_TRUE(file.read<float>("empty").empty());
  EXPECT_EQ(file.read_text("text"), "two\nlines");
  EXPECT_EQ(file.read_text("no text"), "");
  EXPECT_EQ(file.read_attribute<double>("g", "time"), 0.25);
  EXPECT_EQ(file.read_attribute_text("g", "name"), "höhe");
  EXPECT_TRUE(file.has("g/bytes"));
  EXPECT_FALSE(file.has("h/bytes"));
  EXPECT_FALSE(file.has_attribute("g", "unit"));
}

TEST(Hdf5File, RefusesOtherTypesAndSizes) {
  const TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write<double>("real", {1, 2});
    file.write<std::int64_t>("whole", {1, 2});
    file.write_text("text", "t");
    file.close();
  }
  const Hdf5File file = Hdf5File::open(folder / "a.h5");
  EXPECT_THROW(file.read<float>("real"), InputError);
  EXPECT_THROW(file.read<std::int64_t>("real"), InputError);
  EXPECT_THROW(file.read<std::int32_t>("whole"), InputError);
  EXPECT_THROW(file.read<double>("text"), InputError);
  EXPECT_THROW(file.read_text("real"), InputError);
  EXPECT_THROW(file.read<double>("missing"), InputError);
  EXPECT_THROW(file.names("real"), InputError);
  const std::string error = error_of([&] { file.read<double>("real", {3, 0}); });
  EXPECT_NE(error.find("real"), error.npos) << error;
  EXPECT_NE(error.find("a.h5"), error.npos) << error;
  EXPECT_NE(error.find("expected 3"), error.npos) << error;
}

TEST(Hdf5File, SaysWhyAFileCannotBeUsed) {
  const TemporaryFolder folder;
  write_bytes(folder / "text.h5", "this is no HDF5 file");
  write_bytes(folder / "empty.h5", "");
  EXPECT_NE(error_of([&] { Hdf5File::open(folder / "missing.h5"); }).find("No such file"), std::string::npos);
  EXPECT_NE(error_of([&] { Hdf5File::open(folder / "text.h5"); }).find("signature"), std::string::npos);
  EXPECT_THROW(Hdf5File::open(folder / "empty.h5"), InputError);
  EXPECT_THROW(Hdf5File::open(folder.path()), InputError);
  EXPECT_THROW(Hdf5File::create(folder / "missing/a.h5"), Error);
  EXPECT_THROW(Hdf5File::create("/dev/full/a.h5"), Error);
}

TEST(Hdf5File, RefusesAFileCutShort) {
  const TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write<double>("real", std::vector<double>(1000, 1.0));
    file.close();
  }
  const std::string bytes = read_bytes(folder / "a.h5");
  for (std::size_t size = 0; size < bytes.size(); size += 97) {
    write_bytes(folder / "cut.h5", bytes.substr(0, size));
    EXPECT_THROW(Hdf5File::open(folder / "cut.h5").read<double>("real"), InputError) << size;
  }
}

TEST(Hdf5File, RefusesWrongCountsInWriting) {
  const TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.h5");
  const std::vector<double> values(5);
  EXPECT_THROW(file.write<double>("a", std::span<const double>(values), {2, 3}), Error);
  EXPECT_THROW(file.write<double>("no/group", values), Error);
  EXPECT_THROW(file.write_text("t", std::string("a\0b", 3)), Error);
}

}  // namespace
}  // namespace undine
