#include "undine/app/setup/wall_start.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "undine/search/cell_grid.hpp"

namespace undine {
namespace {

/// Height of the first hydrostatic fluid's surface, m; not a number when there is none.
double hydrostatic_surface(const std::vector<Body>& bodies) {
  for (const Body& body : bodies)
    if (body.group == Group::fluid && body.table.has("surface")) return body.table.quantity("surface", unit::length);
  return std::nan("");
}

/// Gives a wall particle the state of the gas nearest to it, among `near`, numbers within the fluid.
template <int N>
void hold_gas(Store<N>& store, const Domain<N>& domain, std::size_t wall_particle,
              const std::vector<std::uint32_t>& near) {
  const std::size_t first = store.range(Group::fluid).begin;
  const auto x = store.template get<field::x>();
  const auto far = [&](std::uint32_t j) { return norm_sq(domain.nearest_image(x[first + j] - x[wall_particle])); };
  const auto nearest = std::ranges::min_element(near, {}, far);
  if (nearest == near.end()) return;
  const std::size_t gas = first + *nearest;
  for (const int f : {field::rho::id, field::e::id, field::m::id, field::rho_0::id})
    store.raw(f)[wall_particle] = store.raw(f)[gas];
  store.materials()[wall_particle] = store.materials()[gas];
}

template <int N>
double density_kernel(const FlowOptions<N>& options, const Vec<N>& d) {
  const double H = options.support.uniform;
  return options.kernels[static_cast<int>(KernelRole::density)].template w<N>(norm(d) / H) / std::pow(H, N);
}

/// sum_b m_b W_ab over wall particles, `near` being their numbers within the walls.
template <int N>
double wall_sum(const CaseSetup<N>& setup, std::size_t a, const std::vector<std::uint32_t>& near) {
  const std::size_t first = setup.store.range(Group::wall).begin;
  const auto x = setup.store.template get<field::x>();
  const auto m = setup.store.template get<field::m>();
  double sum = 0;
  for (const auto b : near)
    sum += m[first + b] * density_kernel(setup.options(), setup.domain.nearest_image(x[a] - x[first + b]));
  return sum;
}

/// sum of V W over an endless lattice of the case's spacing: 1 but for the kernel's discretisation error.
template <int N>
double sum_over_lattice(const CaseSetup<N>& setup) {
  const double dp = setup.spacing;
  const int reach = static_cast<int>(std::ceil(setup.options().support.uniform / dp));
  double sum = 0;
  Vec<N, int> cell;
  for (int k = 0; k < N; ++k) cell[k] = -reach;
  for (;;) {
    Vec<N> d;
    for (int k = 0; k < N; ++k) d[k] = dp * cell[k];
    sum += std::pow(dp, N) * density_kernel(setup.options(), d);
    int axis = 0;
    for (; axis < N; ++axis) {
      if (++cell[axis] <= reach) break;
      cell[axis] = -reach;
    }
    if (axis == N) return sum;
  }
}

/// rho_wref of a modified-density wall particle. "auto": what fluid at rest on the wall lacks to `rest`, which is the
/// wall particles' own sum, less what a whole lattice sums to beyond rho_0.
double wall_reference(const SchemeChoice& choice, double rho_0, double rest, double own_sum, double lattice) {
  if (choice.wall_reference == "given") return choice.wall_reference_density;
  return choice.wall_reference == "auto" ? own_sum + rest - rho_0 * lattice : rho_0;
}

}  // namespace

template <int N>
void start_walls(const std::vector<Body>& bodies, CaseSetup<N>& setup) {
  const double surface = hydrostatic_surface(bodies);
  auto& store = setup.store;
  const auto& options = setup.options();
  const IndexRange walls = store.range(Group::wall), fluid = store.range(Group::fluid);
  const auto x = store.template get<field::x>();
  const double H = options.support.uniform, strength = norm(options.gravity);
  CellGrid<N> near_fluid, near_wall;
  near_fluid.build(x.subspan(fluid.begin, fluid.size()), H, setup.domain);
  near_wall.build(x.subspan(walls.begin, walls.size()), H, setup.domain);
  const double lattice = sum_over_lattice(setup);
  std::vector<std::uint32_t> found;
  for (std::size_t i = walls.begin; i < walls.end; ++i) {
    const auto& material = options.materials[store.materials()[i]];
    near_fluid.find(x[i], H, found);
    double rest = material.rho_0;
    if (!found.empty() && std::isfinite(surface))
      rest = material.density(material.rho_0 * std::max(0.0, strength * surface + dot(options.gravity, x[i])));
    const Body& body = bodies[static_cast<std::size_t>(setup.body_of_id[i])];
    if (!body.given.contains("rho")) store.template get<field::rho>()[i] = rest;
    if (options.wall_density == walls::WallDensity::held) hold_gas(store, setup.domain, i, found);
    near_wall.find(x[i], H, found);
    store.template get<field::rho_wall>()[i] =
        wall_reference(setup.choice, material.rho_0, rest, wall_sum(setup, i, found), lattice);
  }
}

template void start_walls(const std::vector<Body>&, CaseSetup<1>&);
template void start_walls(const std::vector<Body>&, CaseSetup<2>&);
template void start_walls(const std::vector<Body>&, CaseSetup<3>&);

}  // namespace undine
