// A column of water in free fall through an empty plane: ten leapfrog steps with the library, without a case file.
#include <cmath>
#include <cstdio>

#include "undine/integrators/leapfrog.hpp"
#include "undine/schemes/weakly_compressible.hpp"

int main() {
  using namespace undine;
  constexpr int nx = 10, ny = 20;
  constexpr double dp = 0.01, rho_0 = 1000, g = 9.81, dt = 1e-4;

  Store<2> store;
  store.allocate(Fields<field::x, field::v, field::rho, field::h, field::m, field::rho_0, field::mu, field::rho_wall,
                        field::x_list>::set());
  store.append(Group::fluid, nx * ny, 0);
  for (int i = 0; i < nx * ny; ++i) {
    store.get<field::x>()[i] = {{(i % nx + 0.5) * dp, (i / nx + 0.5) * dp}};
    store.get<field::rho>()[i] = store.get<field::rho_0>()[i] = rho_0;
    store.get<field::m>()[i] = rho_0 * dp * dp;
    store.get<field::h>()[i] = 2.6 * dp;
  }

  WeaklyCompressibleOptions<2> options;  // Wendland C2, continuity, symmetric pressure, no viscosity, no walls
  options.support.uniform = 2.6 * dp;
  options.materials = {{"water", rho_0, 0, materials::TaitSoundSpeed{rho_0, 30, 7}}};
  options.gravity = {{0, -g}};

  WeaklyCompressible<2> flow(std::move(store), Domain<2>::unbounded(), options);
  for (int step = 0; step < 10; ++step) integrators::Leapfrog::step(flow, dt);

  const Energies e = flow.energies();
  const double fallen = 0.5 * nx * ny * rho_0 * dp * dp * g * g * flow.time() * flow.time();  // m v^2/2 after free fall
  std::printf("t = %g s, kinetic %.10g J (free fall: %.10g J), total %.10g J\n", flow.time(), e.kinetic, fallen,
              e.total());
  return std::abs(e.kinetic - fallen) < 1e-6 * fallen ? 0 : 1;
}
