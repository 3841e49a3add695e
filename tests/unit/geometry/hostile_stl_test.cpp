// STL files that are damaged, or made to harm: each is read as a mesh whose corners name vertices, or refused with an
// InputError that names the file. Fuzzing (tests/fuzz) looks for more of them.
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "sample_shapes.hpp"
#include "undine/geometry/mesh.hpp"

namespace undine {
namespace {

using sample::TemporaryFile;

class HostileStl : public testing::Test {
 protected:
  std::string bytes_of(StlFormat format) const {
    write_stl(sample::cube(), file_.path(), format);
    std::ifstream stream(file_.path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// What reading complains of; empty where a mesh comes of it. Anything but an InputError fails the test.
  std::string outcome(const std::string& bytes, double scale = 1) const {
    file_.write(bytes);
    try {
      const TriangleMesh mesh = load_stl(file_.path(), scale);
      const auto count = static_cast<int>(mesh.vertices.size());
      EXPECT_FALSE(mesh.triangles.empty());
      for (const auto& corners : mesh.triangles)
        for (const int corner : corners) EXPECT_TRUE(0 <= corner && corner < count);
      for (const Vec3& p : mesh.vertices) EXPECT_TRUE(std::isfinite(norm_sq(p)));
      return {};
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(file_.path()), text.npos) << text;
      return text;
    }
  }
  void expect(const std::string& bytes, const std::string& part, double scale = 1) const {
    const std::string text = outcome(bytes, scale);
    EXPECT_NE(text.find(part), text.npos) << text;
  }

  TemporaryFile file_{"hostile.stl"};
};

// Criterion: what is cut, or has a byte turned round, is read or refused. A cut binary file is always refused.
TEST_F(HostileStl, CutsAndFlipsAreReadOrRefused) {
  const std::string binary = bytes_of(StlFormat::binary), ascii = bytes_of(StlFormat::ascii);
  for (std::size_t size = 0; size < binary.size(); size += 3) EXPECT_NE(outcome(binary.substr(0, size)), "") << size;
  for (std::size_t size = 0; size < ascii.size(); size += 17) outcome(ascii.substr(0, size));
  for (const std::string& good : {binary, ascii})
    for (std::size_t at = 0; at < good.size(); at += 7)
      for (const int bits : {0x01, 0xff}) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ bits);
        outcome(bad);
      }
}

// Criterion: a count is compared with the size of the file before memory is taken for it.
TEST_F(HostileStl, CountsMustFitTheFile) {
  const std::string good = bytes_of(StlFormat::binary);
  for (const std::uint32_t count : {0u, 11u, 13u, 0x7fffffffu, 0xffffffffu}) {
    std::string bad = good;
    std::memcpy(bad.data() + 80, &count, 4);
    EXPECT_NE(outcome(bad), "") << count;
  }
  EXPECT_NE(outcome(good + '\0'), "");
  // So many that the size of the file would be small in 32 bits: 50 x 85,899,346 = 2^32 + 4.
  const std::uint32_t wraps = 85'899'346;
  std::string bad(84 + 4, '\0');
  std::memcpy(bad.data() + 80, &wraps, 4);
  expect(bad, "promises 85899346 triangles");
}

TEST_F(HostileStl, CoordinatesThatAreNoneOrBeyondReason) {
  const std::string good = bytes_of(StlFormat::binary);
  const auto with = [&](float value) {
    std::string bad = good;
    std::memcpy(bad.data() + 84 + 12, &value, 4);
    return bad;
  };
  expect(with(std::numeric_limits<float>::infinity()), "not a finite number");
  expect(with(std::numeric_limits<float>::quiet_NaN()), "not a finite number");
  expect(with(3e38f), "lies too far out", 1e70);
  EXPECT_EQ(outcome(with(-1e-40f)), "");  // as good as 0
  const auto vertex = [](const std::string& number) {
    return "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 " + number +
           " 0\nendloop\nendfacet\nendsolid\n";
  };
  expect(vertex("1e999"), "not a finite number");
  expect(vertex("1e200"), "lies too far out");
  expect(vertex("1e-999"), "no area");
  expect(vertex("0x10"), "'a number' belongs");
  expect(vertex("1e"), "'a number' belongs");
  expect(vertex("--1"), "'a number' belongs");
  for (const double scale :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    expect(good, "scale of a mesh must be above 0", scale);
  expect(good, "lies too far out", 1e101);
}

TEST_F(HostileStl, TextsThatGoOnAndOn) {
  expect("solid", "ends too early");
  expect("solid a\nendsolid a\n", "no triangles");
  expect(std::string(3'000'000, ' '), "cut off or damaged");
  expect("solid\n" + std::string(1'000'000, 'x'), "'" + std::string(40, 'x') + "' stands where");  // quoted in part
  std::string empty_solids;
  for (int k = 0; k < 20'000; ++k) empty_solids += "solid a\nendsolid a\n";
  expect(empty_solids, "no triangles");
  expect("solid a\nfacet normal 0 0", "ends too early");
  expect(std::string("solid a\n\0facet", 14), "cut off or damaged");  // a zero byte makes it binary
}

}  // namespace
}  // namespace undine
