#include "undine/io/checksum.hpp"

#include <algorithm>
#include <limits>

#include "io_test.hpp"
#include "undine/io/checkpoint.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

using test::sample_frame;
using test::TemporaryFolder;
using test::write_bytes;

std::string hash_of(const std::string& text, std::size_t piece) {
  Hash64 hash;
  for (std::size_t at = 0; at < text.size(); at += piece)
    hash.add_values(std::span<const char>(text).subspan(at, std::min(piece, text.size() - at)));
  return hash.text();
}

TEST(Hash64, AgreesWithXxhsum) {
  EXPECT_EQ(Hash64().text(), "ef46db3751d8e999");
  EXPECT_EQ(hash_of("a", 1), "d24ec4f1a98c6e5b");
  EXPECT_EQ(hash_of("abc", 1), "44bc2cf5ad770999");
  EXPECT_EQ(hash_of("Nobody inspects the spammish repetition", 100), "fbcea83c8a378bf1");
  const std::string text = "The quick brown fox jumps over the lazy dog, and again over the lazy dog.";
  for (const std::size_t piece : {1, 7, 31, 32, 33, 64}) EXPECT_EQ(hash_of(text, piece), hash_of(text, 1000));
}

/// The same particles in the opposite order, columns too.
OwnedFrame reversed(OwnedFrame frame) {
  for (OwnedColumn& column : frame.columns) {
    const OwnedColumn old = column;
    const auto width = static_cast<std::size_t>(column.components);
    for (std::size_t i = 0; i < frame.particles; ++i)
      std::copy_n(&old.data[i * width], width, &column.data[(frame.particles - 1 - i) * width]);
  }
  for (OwnedIntColumn& column : frame.integers)
    std::visit([](auto& values) { std::ranges::reverse(values); }, column.data);
  std::ranges::reverse(frame.columns);
  std::ranges::reverse(frame.integers);
  return frame;
}

TEST(Checksum, DoesNotDependOnOrder) {
  const OwnedFrame frame = sample_frame(20, 3);
  EXPECT_EQ(checksum(frame), checksum(reversed(frame)));
}

TEST(Checksum, SeesEveryChange) {
  const OwnedFrame frame = sample_frame(20, 2);
  const auto changed = [&](auto change) {
    OwnedFrame other = frame;
    change(other);
    return checksum(other) != checksum(frame);
  };
  EXPECT_TRUE(changed([](OwnedFrame& f) { f.columns[2].data[7] = std::nextafter(f.columns[2].data[7], 1.0); }));
  EXPECT_TRUE(changed([](OwnedFrame& f) { f.columns[0].name = "density"; }));
  EXPECT_TRUE(changed([](OwnedFrame& f) { f.time = 1; }));
  EXPECT_TRUE(changed([](OwnedFrame& f) { f.step = 1; }));
  EXPECT_TRUE(changed([](OwnedFrame& f) { f.integers.pop_back(); }));
  EXPECT_TRUE(changed([](OwnedFrame& f) { std::get<1>(f.integers[1].data)[3] = 9; }));
  EXPECT_FALSE(changed([](OwnedFrame& f) { f.columns[0].unit = "g/cm^3"; }));
}

TEST(Checksum, TakesAllNansAsOne) {
  OwnedFrame a = sample_frame(2, 2);
  OwnedFrame b = a;
  a.columns[0].data[0] = std::numeric_limits<double>::quiet_NaN();
  b.columns[0].data[0] = -std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(checksum(a), checksum(b));
}

TEST(Checksum, OfFiles) {
  const TemporaryFolder folder;
  const OwnedFrame frame = sample_frame(50, 2);
  write_checkpoint(folder / "a.checkpoint", {frame.view(), {.reals = {{"dt", 1}}}});
  write_snapshot(folder / "a.vtkhdf", frame.view(), {.fields = Precision::double_precision});
  write_bytes(folder / "text", "neither");
  EXPECT_EQ(checksum_file(folder / "a.checkpoint"), checksum(frame));
  EXPECT_EQ(checksum_file(folder / "a.vtkhdf"), checksum(frame));
  EXPECT_THROW(checksum_file(folder / "text"), InputError);
  EXPECT_THROW(checksum_file(folder / "missing"), InputError);
}

}  // namespace
}  // namespace undine
