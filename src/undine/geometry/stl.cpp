// Reading and writing STL files, ASCII and binary.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/geometry/mesh.hpp"

namespace undine {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t header_size = 84;
constexpr std::size_t record_size = 50;
constexpr std::size_t most_triangles = 500'000'000;
constexpr double farthest = 1e100;  // m

std::string read_file(const std::string& path) {
  std::error_code code;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, code)) {
    throw InputError({.what = "cannot read the STL file",
                      .where = {.file = path},
                      .fix = "check the path; it is relative to where the program runs"});
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Triangles before welding: three vertices each.
class Soup {
 public:
  Soup(const std::string& path, double scale) : scale_(scale) { mesh_.source = path; }

  void add(const std::array<Vec3, 3>& corners, const SourceLocation& where, const std::string& which) {
    for (const Vec3& p : corners) {
      if (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2])) continue;
      throw InputError({.what = which + " has a coordinate that is not a finite number",
                        .where = where,
                        .why = fmt::format("a vertex is ({}, {}, {})", p[0], p[1], p[2]),
                        .fix = "export the mesh again, or repair it"});
    }
    for (const Vec3& p : corners) {
      if (scale_ * std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) <= farthest) continue;
      throw InputError({.what = which + " lies too far out",
                        .where = where,
                        .why = fmt::format("a vertex is ({}, {}, {}), times the scale {}; squares of more than {} m "
                                           "are no numbers",
                                           p[0], p[1], p[2], scale_, farthest),
                        .fix = "repair the mesh, or set its scale"});
    }
    const Vec3 ab = corners[1] - corners[0];
    const Vec3 ac = corners[2] - corners[0];
    const double longest = std::max({norm_sq(ab), norm_sq(ac), norm_sq(ac - ab)});
    if (norm(cross(ab, ac)) <= 1e-12 * longest) {
      const Vec3& p = corners[0];
      throw InputError(
          {.what = which + " is degenerate: it has no area",
           .where = where,
           .why = fmt::format("its corners lie on one line or coincide, at ({}, {}, {})", p[0], p[1], p[2]),
           .fix = "remove such triangles with a mesh repair tool"});
    }
    const int first = static_cast<int>(mesh_.vertices.size());
    for (const Vec3& p : corners) mesh_.vertices.push_back(scale_ * p);
    mesh_.triangles.push_back({first, first + 1, first + 2});
  }

  TriangleMesh finish() {
    if (mesh_.triangles.empty()) {
      throw InputError({.what = "the STL file holds no triangles", .where = {.file = mesh_.source}});
    }
    TriangleMesh mesh = weld(mesh_);
    orient_outward(mesh);
    return mesh;
  }

 private:
  double scale_;
  TriangleMesh mesh_;
};

class AsciiReader {
 public:
  AsciiReader(const std::string& text, const std::string& path, Soup& soup) : text_(text), path_(path), soup_(soup) {}

  void read() {
    while (true) {
      const auto word = next();
      if (word.empty()) break;
      if (!same(word, "solid")) fail(word, "solid");
      skip_line();
      read_solid();
    }
  }

 private:
  void read_solid() {
    while (true) {
      const auto word = next();
      if (same(word, "endsolid")) return skip_line();
      if (!same(word, "facet")) fail(word, "facet or endsolid");
      const int line = line_;
      expect("normal");
      // The normal follows from the corners; files with a missing or NaN one are common.
      for (int k = 0; k < 3; ++k) {
        if (next().empty()) fail("", "a normal");
      }
      expect("outer");
      expect("loop");
      std::array<Vec3, 3> corners;
      for (Vec3& corner : corners) {
        expect("vertex");
        for (int k = 0; k < 3; ++k) corner[k] = number();
      }
      expect("endloop");
      expect("endfacet");
      soup_.add(corners, {path_, line, 0}, fmt::format("triangle {}", ++count_));
    }
  }

  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return std::string_view(text_).substr(begin, at_ - begin);
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  void expect(std::string_view wanted) {
    if (const auto word = next(); !same(word, wanted)) fail(word, wanted);
  }
  double number() {
    auto word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    double x = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), x);
    const bool ok = !word.empty() && end == word.data() + word.size();
    if (ok && code == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
    if (!ok || code != std::errc()) fail(word, "a number");
    return x;
  }
  [[noreturn]] void fail(std::string_view found, std::string_view wanted) const {
    if (found.empty()) {
      throw InputError({.what = "the ASCII STL file ends too early",
                        .where = {path_, line_, 0},
                        .why = fmt::format("'{}' was expected, after {} whole triangles", wanted, count_),
                        .fix = "the file is cut off: export or copy it again"});
    }
    throw InputError({.what = fmt::format("'{}' stands where '{}' belongs", found.substr(0, 40), wanted),
                      .where = {path_, line_, 0},
                      .why = "this is not the ASCII STL format",
                      .fix = "export the mesh again"});
  }
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  static bool same(std::string_view word, std::string_view lower) {
    const auto fold = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                      [&](char a, char b) { return fold(a) == b; });
  }

  const std::string& text_;
  const std::string& path_;
  Soup& soup_;
  std::size_t at_ = 0;
  int line_ = 1;
  std::size_t count_ = 0;
};

std::size_t binary_count(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header_size) std::memcpy(&count, bytes.data() + 80, 4);
  return count;
}

/// The size decides: many binary files start with "solid" as ASCII ones do.
bool looks_ascii(const std::string& bytes) {
  if (bytes.size() >= header_size && bytes.size() == header_size + record_size * binary_count(bytes)) return false;
  const auto start = std::string_view(bytes).substr(0, 2000);
  const auto solid = start.find_first_not_of(" \t\r\n");
  if (solid == std::string_view::npos || start.find('\0') != std::string_view::npos) return false;
  std::string word(start.substr(solid, 5));
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word == "solid";
}

void read_binary(const std::string& bytes, const std::string& path, Soup& soup) {
  const std::size_t count = binary_count(bytes);
  if (bytes.size() != header_size + record_size * count || bytes.size() < header_size || count > most_triangles) {
    throw InputError(
        {.what = "the STL file is cut off or damaged",
         .where = {.file = path},
         .why = bytes.size() < header_size
                    ? fmt::format("it has {} bytes, less than the header of a binary file, and is no ASCII "
                                  "file, which would start with 'solid'",
                                  bytes.size())
                    : fmt::format("its header promises {} triangles, which take {} bytes; it has {}", count,
                                  header_size + record_size * count, bytes.size()),
         .fix = "export or copy it again"});
  }
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 12> x;
    std::memcpy(x.data(), bytes.data() + header_size + record_size * i, sizeof x);
    std::array<Vec3, 3> corners;
    for (int c = 0; c < 3; ++c) corners[c] = {{x[3 + 3 * c], x[4 + 3 * c], x[5 + 3 * c]}};
    soup.add(corners, {.file = path}, fmt::format("triangle {} of {}", i + 1, count));
  }
}

}  // namespace

TriangleMesh load_stl(const std::string& path, double scale) {
  if (!(std::isfinite(scale) && scale > 0)) {
    throw InputError({.what = "the scale of a mesh must be above 0",
                      .where = {.file = path},
                      .why = fmt::format("it is {}", scale)});
  }
  const std::string bytes = read_file(path);
  Soup soup(path, scale);
  if (looks_ascii(bytes)) {
    AsciiReader(bytes, path, soup).read();
  } else {
    read_binary(bytes, path, soup);
  }
  return soup.finish();
}

void write_stl(const TriangleMesh& mesh, const std::string& path, StlFormat format) {
  std::string out;
  if (format == StlFormat::binary) {
    out = "binary STL written by undine";
    out.resize(header_size);
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    std::memcpy(out.data() + 80, &count, 4);
  } else {
    out = "solid undine\n";
  }
  for (const auto& t : mesh.triangles) {
    const std::array<Vec3, 3> p{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    Vec3 n = cross(p[1] - p[0], p[2] - p[0]);
    n = n / std::max(norm(n), 1e-300);
    if (format == StlFormat::binary) {
      std::array<float, 12> x;
      for (int k = 0; k < 3; ++k) {
        x[k] = static_cast<float>(n[k]);
        for (int c = 0; c < 3; ++c) x[3 + 3 * c + k] = static_cast<float>(p[c][k]);
      }
      out.append(reinterpret_cast<const char*>(x.data()), sizeof x);
      out.append(2, '\0');
    } else {
      out += fmt::format("  facet normal {} {} {}\n    outer loop\n", n[0], n[1], n[2]);
      for (const Vec3& v : p) out += fmt::format("      vertex {} {} {}\n", v[0], v[1], v[2]);
      out += "    endloop\n  endfacet\n";
    }
  }
  if (format == StlFormat::ascii) out += "endsolid undine\n";
  std::ofstream file(path, std::ios::binary);
  file.write(out.data(), static_cast<std::streamsize>(out.size()));
  if (!file.flush()) throw InputError({.what = "cannot write the STL file", .where = {.file = path}});
}

}  // namespace undine
