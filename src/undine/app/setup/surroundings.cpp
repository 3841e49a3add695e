#include "undine/app/setup/surroundings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "undine/app/setup/start.hpp"
#include "undine/core/error.hpp"
#include "undine/geometry/embed.hpp"

namespace undine {
namespace {

template <int N>
void read_body_force(const Table& root, CaseSetup<N>& setup) {
  if (!root.has("body_force")) return;
  const auto formulas = root.expressions("body_force", N);
  const IndexRange fluid = setup.store.range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const Vec3 p = widen<N>(setup.store.template get<field::x>()[i]);
    for (int k = 0; k < N; ++k)
      if (!std::isfinite(formulas[k](p[0], p[1], p[2], 0)))
        refuse_not_finite(root, "body_force", fmt::format("body_force[{}]", k), p);
  }
  setup.options().body_force = [formulas](const Vec<N>& x, double t) {
    const Vec3 p = widen<N>(x);
    Vec<N> a;
    for (int k = 0; k < N; ++k) a[k] = formulas[k](p[0], p[1], p[2], t);
    return a;
  };
}

/// From a point in the wall to its mirror image across the nearest place of the surface.
Vec3 to_mirror(const ReflectingSurface& surface, const Vec3& p) {
  return -2 * surface.depth(0, p) * surface.normal(0, p);
}

/// What the scheme is told of walls beyond their particles, which have their ids in the order of the store here.
template <int N>
void plan_walls(const std::vector<Body>& bodies, CaseSetup<N>& setup) {
  auto& plan = setup.options().walls;
  const IndexRange walls = setup.store.range(Group::wall);
  const bool mirrors = setup.options().wall_density == walls::WallDensity::mirrored;
  if (!plan.moves() && !mirrors) return;
  plan.first_id = static_cast<std::int64_t>(walls.begin);
  const auto x = setup.store.template get<field::x>();
  for (std::size_t i = walls.begin; i < walls.end; ++i) {
    const Body& body = bodies[static_cast<std::size_t>(setup.body_of_id[i])];
    if (plan.moves()) {
      plan.motion.push_back(body.motion);
      plan.start.push_back(x[i]);
    }
    if (mirrors) plan.to_mirror.push_back(narrow<N>(to_mirror(*body.surface, widen<N>(x[i]))));
  }
}

template <int N>
void connect_distance(const CaseWalls<N>& walls, CaseSetup<N>& setup) {
  if (setup.choice.wall_force != walls::WallForce::distance) return;
  const double distance = walls.treatment.positive("distance", unit::length, 0.5 * setup.spacing);
  setup.options().pushed_out = [surface = walls.pushing, distance](const Vec<N>& x) -> Vec<N> {
    return narrow<N>(surface->pushed_out(widen<N>(x), distance));
  };
}

template <int N>
void connect_reflector(const Table& root, const std::shared_ptr<ReflectingSurface>& walls, CaseSetup<N>& setup) {
  if (walls->empty()) return;
  setup.options().reflector = [walls](const Vec<N>& from, const Vec<N>& to, const Vec<N>& v) -> Bounce<N> {
    const Vec3 a = widen<N>(from), b = widen<N>(to);
    if (walls->clear(a, b)) return {to, v};
    const Reflection r = walls->reflect(a, b, widen<N>(v));
    return {narrow<N>(r.position), narrow<N>(r.velocity)};
  };
  const IndexRange fluid = setup.store.range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const Vec3 p = widen<N>(setup.store.template get<field::x>()[i]);
    if (walls->depth(p) >= 0) continue;
    throw InputError({.what = "fluid begins on the wrong side of a wall",
                      .where = root.where("wall"),
                      .why = fmt::format("a particle at ({:.4g}, {:.4g}, {:.4g}) m is {:.3g} m inside it", p[0], p[1],
                                         p[2], -walls->depth(p)),
                      .fix = "move the fluid, cut the wall out with a 'difference', or set fluid = "
                             "\"inside\"/\"outside\" on the wall"});
  }
}

/// Fluid that would leave the domain comes back as from a wall; at corners along each axis.
template <int N>
Bounce<N> kept_inside(const Domain<N>& domain, Bounce<N> bounce) {
  for (int k = 0; k < N; ++k) {
    if (domain.periodic[k] || !std::isfinite(bounce.x[k])) continue;
    if (bounce.x[k] >= domain.low[k] && bounce.x[k] <= domain.high[k]) continue;
    const double face = bounce.x[k] < domain.low[k] ? domain.low[k] : domain.high[k];
    bounce.x[k] = std::clamp(2 * face - bounce.x[k], domain.low[k], domain.high[k]);
    bounce.v[k] = -bounce.v[k];
  }
  return bounce;
}

template <int N>
void connect_domain(CaseSetup<N>& setup) {
  setup.options().reflector = [walls = setup.options().reflector, domain = setup.domain](
                                  const Vec<N>& from, const Vec<N>& to, const Vec<N>& v) -> Bounce<N> {
    return kept_inside(domain, walls ? walls(from, to, v) : Bounce<N>{to, v});
  };
}

template <int N>
void connect_ghosts(const std::vector<Body>& bodies, const GhostWalls<N>& ghosts, CaseSetup<N>& setup) {
  auto& options = setup.options();
  if (!setup.choice.ghosts) return;
  double largest = options.support.uniform;
  for (const Body& body : bodies) largest = std::max(largest, options.support.uniform * body.coarser);
  options.mirrored_support = largest * setup.choice.support_growth;
  const double reach = options.mirrored_support * (1 + options.neighbours.skin);
  options.mirrors = ghosts.mirrors(*setup.choice.ghosts, reach, setup.domain);
}

}  // namespace

template <int N>
void connect_surroundings(const Table& root, const std::vector<Body>& bodies, const CaseWalls<N>& walls,
                          CaseSetup<N>& setup) {
  read_body_force(root, setup);
  plan_walls(bodies, setup);
  connect_distance(walls, setup);
  connect_reflector(root, walls.reflecting, setup);
  if (walls.domain_reflects) connect_domain(setup);
  connect_ghosts(bodies, walls.ghosts, setup);
}

template void connect_surroundings(const Table&, const std::vector<Body>&, const CaseWalls<1>&, CaseSetup<1>&);
template void connect_surroundings(const Table&, const std::vector<Body>&, const CaseWalls<2>&, CaseSetup<2>&);
template void connect_surroundings(const Table&, const std::vector<Body>&, const CaseWalls<3>&, CaseSetup<3>&);

}  // namespace undine
