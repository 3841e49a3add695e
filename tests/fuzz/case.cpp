// Whole cases, read as `undine check` reads them: the TOML, every key, formulas, shapes, and files that a case names,
// of which there is one of each kind beside it.
#include <cstdlib>

#include "fuzz/fuzz.hpp"
#include "undine/app/case_outline.hpp"
#include "undine/geometry/mesh.hpp"
#include "undine/io/snapshot.hpp"

namespace {

void write_files() {
  using namespace undine;
  const auto& here = fuzz::folder();
  TriangleMesh mesh;
  mesh.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  write_stl(mesh, (here.path() / "mesh.stl").string(), StlFormat::ascii);
  here.file("points.csv", "x,y,z,vx,rho\n0.1,0.1,0,1,1000\n0.2,0.1,0,0,1001\n");
  here.file("table.csv", "time [s],height [m]\n0,0.3\n1,0.2\n");
  const double x[]{0.1, 0.1, 0.2, 0.1}, rho[]{1000, 1001};
  const std::int64_t id[]{0, 1};
  write_snapshot(here.path() / "a.vtkhdf", {.dimensions = 2,
                                            .particles = 2,
                                            .columns = {{"x", "m", 2, x}, {"rho", "kg/m^3", 1, rho}},
                                            .integers = {{"id", id}}});
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  setenv("UNDINE_MEMORY", "5e6", 1);  // more particles would only take time
  write_files();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace undine;
  using namespace undine::fuzz;
  RunOptions options;
  options.file = folder().file("case.toml", text_of(data, size));
  options.threads = 1;
  accepted([&] {
    const CaseOutline outline = outline_case(options);
    require(outline.dimensions >= 1 && outline.dimensions <= 3 && outline.fluid > 0 && outline.hash.size() == 16);
  });
  return 0;
}
