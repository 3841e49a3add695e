// Meshes: ASCII and binary STL, and the solid that a case makes of one.
#include <cmath>

#include "fuzz/fuzz.hpp"
#include "undine/geometry/mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace undine;
  using namespace undine::fuzz;
  const auto path = folder().file("mesh.stl", text_of(data, size));
  accepted([&] {
    auto mesh = load_stl(path.string(), 0.5);
    const auto count = static_cast<int>(mesh.vertices.size());
    for (const auto& corners : mesh.triangles)
      for (const int corner : corners) require(0 <= corner && corner < count);
    const Bounds box = bounds_of(mesh);
    const ShapePtr shape = make_mesh(std::move(mesh));
    for (const double t : {-0.1, 0.0, 0.3, 0.5, 1.0}) {
      Vec3 p{};
      for (int k = 0; k < 3; ++k) p[k] = box.lo[k] + t * (box.hi[k] - box.lo[k]);
      require(!std::isnan(shape->signed_distance(p)));
      shape->spans(box.lo, p);
    }
  });
  return 0;
}
