#include "undine/io/checkpoint.hpp"

#include <bit>
#include <csignal>
#include <limits>

#include <sys/resource.h>

#include "io_test.hpp"
#include "undine/io/checksum.hpp"

namespace undine {
namespace {

using test::error_of;
using test::read_bytes;
using test::sample_frame;
using test::TemporaryFolder;
using test::write_bytes;

CheckpointState sample_state() {
  return {.reals = {{"dt", 1e-5}, {"energy lost", -0.0}},
          .integers = {{"big", std::numeric_limits<std::int64_t>::min()}},
          .lists = {{"sums", {1, 2, 3}}, {"none", {}}},
          .texts = {{"case", "[time]\nend = 1  # ä\n"}, {"hash", "0123456789abcdef"}, {"empty", ""}}};
}

TEST(Checkpoint, ReadsBackEveryBit) {
  const TemporaryFolder folder;
  for (const int dimensions : {1, 2, 3}) {
    for (const std::size_t particles : {0, 1, 2000}) {
      OwnedFrame frame = sample_frame(particles, dimensions);
      if (particles > 0) frame.columns[0].data[0] = std::bit_cast<double>(0x7ff8000000000123);  // a NaN with a message
      write_checkpoint(folder / "a.checkpoint", {frame.view(), sample_state()});
      const OwnedCheckpoint read = read_checkpoint(folder / "a.checkpoint");
      EXPECT_EQ(read.state, sample_state());
      EXPECT_EQ(read.frame.time, frame.time);
      EXPECT_EQ(read.frame.step, frame.step);
      ASSERT_EQ(read.frame.columns.size(), frame.columns.size());
      for (std::size_t k = 0; k < frame.columns.size(); ++k) {
        const OwnedColumn& a = read.frame.columns[k];
        const OwnedColumn& b = frame.columns[k];
        EXPECT_EQ(a.name, b.name);
        EXPECT_EQ(a.unit, b.unit);
        EXPECT_EQ(a.components, b.components);
        ASSERT_EQ(a.data.size(), b.data.size());
        for (std::size_t i = 0; i < a.data.size(); ++i)
          EXPECT_EQ(std::bit_cast<std::uint64_t>(a.data[i]), std::bit_cast<std::uint64_t>(b.data[i]));
      }
      for (std::size_t k = 0; k < frame.integers.size(); ++k)
        EXPECT_EQ(read.frame.integers[k].data, frame.integers[k].data);
    }
  }
  EXPECT_TRUE(is_checkpoint(folder / "a.checkpoint"));
}

TEST(Checkpoint, IsRefusedAtEveryLengthButItsOwn) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "a.checkpoint", {sample_frame(3, 2).view(), sample_state()});
  const std::string bytes = read_bytes(folder / "a.checkpoint");
  write_bytes(folder / "cut.checkpoint", bytes + '\0');
  EXPECT_THROW(read_checkpoint(folder / "cut.checkpoint"), InputError);
  for (std::size_t size = bytes.size(); size-- > 0;) {
    std::filesystem::resize_file(folder / "cut.checkpoint", size);
    EXPECT_THROW(read_checkpoint(folder / "cut.checkpoint"), InputError) << size;
  }
}

TEST(Checkpoint, NoticesEveryChangedByte) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "a.checkpoint", {sample_frame(3, 2).view(), sample_state()});
  const std::string bytes = read_bytes(folder / "a.checkpoint");
  std::fstream stream(folder / "a.checkpoint", std::ios::binary | std::ios::in | std::ios::out);
  const auto put = [&](std::size_t at, char value) {
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(value).flush();
  };
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    put(at, static_cast<char>(bytes[at] ^ (1 << (at % 8))));
    EXPECT_THROW(read_checkpoint(folder / "a.checkpoint"), InputError) << at;
    put(at, bytes[at]);
  }
  EXPECT_NO_THROW(read_checkpoint(folder / "a.checkpoint"));
}

TEST(Checkpoint, SaysWhyAFileIsRefused) {
  const TemporaryFolder folder;
  const auto reason = [&](const std::string& name) { return error_of([&] { read_checkpoint(folder / name); }); };
  write_bytes(folder / "other", "some text");
  write_bytes(folder / "empty", "");
  write_bytes(folder / "newer", "undine checkpoint\nformat 7\n");
  EXPECT_NE(reason("missing").find("No such file"), std::string::npos);
  EXPECT_NE(reason("other").find("not a checkpoint"), std::string::npos);
  EXPECT_NE(reason("empty").find("empty"), std::string::npos);
  EXPECT_NE(reason("newer").find("its format is 7"), std::string::npos);
  EXPECT_THROW(read_checkpoint(folder.path()), InputError);
}

TEST(Checkpoint, RefusesNamesThatCannotBeStored) {
  const TemporaryFolder folder;
  const OwnedFrame frame = sample_frame(3, 2);
  EXPECT_THROW(write_checkpoint(folder / "a", {frame.view(), {.reals = {{"a/b", 1}}}}), Error);
  EXPECT_THROW(write_checkpoint(folder / "a", {frame.view(), {.texts = {{"", "t"}}}}), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// In a child process, where files may not grow beyond a limit: as on a full disk, the write fails part of the way.
[[noreturn]] void write_under_limit(const std::filesystem::path& path) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit = {40'000, 40'000};
  setrlimit(RLIMIT_FSIZE, &limit);
  const OwnedFrame frame = sample_frame(2000, 3);
  const std::string error = error_of([&] { write_checkpoint(path, {frame.view(), sample_state()}); });
  std::exit(error.find("File too large") != error.npos ? 0 : 1);
}

TEST(CheckpointDeathTest, KeepsTheOlderOneWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "a.checkpoint", {sample_frame(3, 2).view(), sample_state()});
  EXPECT_EXIT(write_under_limit(folder / "a.checkpoint"), testing::ExitedWithCode(0), "");
  EXPECT_EQ(read_checkpoint(folder / "a.checkpoint").frame.particles, 3u);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.checkpoint.tmp"));
}

}  // namespace
}  // namespace undine
