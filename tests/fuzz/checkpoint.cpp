// Checkpoints: files as they come, files whose header and checksum are right but whose content is not, and files that
// the HDF5 library accepts but whose objects are not what they should be.
#include "undine/io/checkpoint.hpp"

#include <fmt/format.h>

#include "fuzz/fuzz.hpp"
#include "fuzz/hdf5_maker.hpp"
#include "undine/io/checksum.hpp"

namespace {

constexpr std::size_t header_size = 512;

/// The content with the header that read_checkpoint() asks for.
std::string sealed(std::string_view content) {
  undine::Hash64 hash;
  hash.add_values(std::span<const char>(content));
  std::string header =
      fmt::format("undine checkpoint\nformat 1\nbytes {:020}\nxxh64 {}\n", header_size + content.size(), hash.text());
  header.resize(header_size, '\0');
  return header.append(content);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace undine;
  using namespace undine::fuzz;
  static const std::vector<Hdf5Object> objects{
      {.name = "frame", .kind = Hdf5Kind::group},
      {.name = "frame", .attribute = "time", .kind = Hdf5Kind::real},
      {.name = "frame", .attribute = "step", .kind = Hdf5Kind::whole, .value = 7},
      {.name = "frame", .attribute = "dimensions", .kind = Hdf5Kind::whole, .value = 2},
      {.name = "frame", .attribute = "particles", .kind = Hdf5Kind::whole, .value = 4},
      {.name = "frame", .attribute = "position", .kind = Hdf5Kind::text, .text = "x"},
      {.name = "columns", .kind = Hdf5Kind::group},
      {.name = "columns/x", .kind = Hdf5Kind::real, .rows = 4, .columns = 2},
      {.name = "columns/x", .attribute = "unit", .kind = Hdf5Kind::text, .text = "m"},
      {.name = "columns/rho", .kind = Hdf5Kind::real, .rows = 4, .columns = 1},
      {.name = "columns/rho", .attribute = "unit", .kind = Hdf5Kind::text, .text = "kg/m^3"},
      {.name = "integers", .kind = Hdf5Kind::group},
      {.name = "integers/id", .kind = Hdf5Kind::whole, .rows = 4},
      {.name = "state", .kind = Hdf5Kind::group},
      {.name = "state/reals", .kind = Hdf5Kind::group},
      {.name = "state/reals/time", .kind = Hdf5Kind::real, .rows = 1},
      {.name = "state/integers", .kind = Hdf5Kind::group},
      {.name = "state/integers/builds", .kind = Hdf5Kind::whole, .rows = 1},
      {.name = "state/lists", .kind = Hdf5Kind::group},
      {.name = "state/lists/powers", .kind = Hdf5Kind::real, .rows = 4},
      {.name = "state/texts", .kind = Hdf5Kind::group},
      {.name = "state/texts/case", .kind = Hdf5Kind::text, .text = "case"}};
  const auto path = folder().path() / "a.checkpoint";
  const auto read = [&] {
    accepted([&] {
      const auto found = read_checkpoint(path);
      check(found.frame.view());
      checksum(found.frame);
    });
  };
  if (make_hdf5(path, header_size, objects, data, size)) {
    std::ifstream stream(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    folder().file("a.checkpoint", sealed(std::string_view(bytes).substr(header_size)));
    read();
    return 0;
  }
  const auto bytes = text_of(data, size);
  folder().file("a.checkpoint", bytes);
  read();
  folder().file("a.checkpoint", sealed(bytes.substr(std::min(size, header_size))));
  read();
  return 0;
}
