// Snapshots: files as they come, and files that the HDF5 library accepts but whose objects are not what they should be.
#include "undine/io/snapshot.hpp"

#include "fuzz/fuzz.hpp"
#include "fuzz/hdf5_maker.hpp"
#include "undine/io/checksum.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace undine;
  using namespace undine::fuzz;
  static const std::vector<Hdf5Object> objects{
      {.name = "VTKHDF", .kind = Hdf5Kind::group},
      {.name = "VTKHDF", .attribute = "Type", .kind = Hdf5Kind::text, .text = "UnstructuredGrid"},
      {.name = "VTKHDF", .attribute = "time", .kind = Hdf5Kind::real},
      {.name = "VTKHDF", .attribute = "step", .kind = Hdf5Kind::whole},
      {.name = "VTKHDF", .attribute = "dimensions", .kind = Hdf5Kind::whole, .value = 2},
      {.name = "VTKHDF", .attribute = "position", .kind = Hdf5Kind::text, .text = "x"},
      {.name = "VTKHDF/NumberOfPoints", .kind = Hdf5Kind::whole, .rows = 1, .value = 4},
      {.name = "VTKHDF/Points", .kind = Hdf5Kind::real, .rows = 4, .columns = 3},
      {.name = "VTKHDF/Points", .attribute = "components", .kind = Hdf5Kind::whole, .value = 2},
      {.name = "VTKHDF/Points", .attribute = "unit", .kind = Hdf5Kind::text, .text = "m"},
      {.name = "VTKHDF/PointData", .kind = Hdf5Kind::group},
      {.name = "VTKHDF/PointData/rho", .kind = Hdf5Kind::real, .rows = 4},
      {.name = "VTKHDF/PointData/v", .kind = Hdf5Kind::real, .rows = 4, .columns = 3},
      {.name = "VTKHDF/PointData/v", .attribute = "components", .kind = Hdf5Kind::whole, .value = 2},
      {.name = "VTKHDF/PointData/stress", .kind = Hdf5Kind::real, .rows = 4, .columns = 9},
      {.name = "VTKHDF/PointData/stress", .attribute = "components", .kind = Hdf5Kind::whole, .value = 4},
      {.name = "VTKHDF/PointData/id", .kind = Hdf5Kind::whole, .rows = 4}};
  const auto path = folder().path() / "a.vtkhdf";
  if (!make_hdf5(path, 0, objects, data, size)) folder().file("a.vtkhdf", text_of(data, size));
  accepted([&] {
    const auto frame = read_snapshot(path);
    check(frame.view());
    checksum(frame);
    require(read_positions(path).particles == frame.particles);
  });
  return 0;
}
