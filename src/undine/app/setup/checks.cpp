#include "undine/app/setup/checks.hpp"

#include <optional>
#include <set>

#include <fmt/format.h>

#include "undine/core/error.hpp"
#include "undine/geometry/bounds.hpp"
#include "undine/geometry/embed.hpp"
#include "undine/geometry/points.hpp"

namespace undine {
namespace {

template <int N>
void check_period(const Body& body, const Domain<N>& domain) {
  Bounds box;
  for (const Vec3& p : body.points) box.include(p);
  for (int k = 0; k < N; ++k)
    if (domain.periodic[k] && box.hi[k] - box.lo[k] > domain.length(k))
      throw InputError(
          {.what = fmt::format("'{}' is longer than the period along {}", body.name, "xyz"[k]),
           .where = body.table.where(),
           .why = fmt::format(
               "its particles reach from {:.4g} to {:.4g} m, the period is {:.4g} m: it would lie on its own image",
               box.lo[k], box.hi[k], domain.length(k)),
           .fix = "shorten it to the period, name its two ends there in 'open', or widen [domain]"});
}

void complain_of(const std::optional<Overlap>& overlap, const Body& a, const Body& b, double spacing) {
  if (!overlap) return;
  const Vec3 p = a.points[overlap->a];
  if (&a == &b)
    throw InputError({.what = fmt::format("two particles of '{}' nearly coincide", a.name),
                      .where = a.table.where(),
                      .why = fmt::format("they are {:.3g} m apart near ({:.4g}, {:.4g}, {:.4g}) m, spacing {:.4g} m",
                                         overlap->distance, p[0], p[1], p[2], spacing),
                      .fix = "remove one of them from the list, or lessen 'jitter'"});
  throw InputError({.what = fmt::format("'{}' and '{}' overlap", a.name, b.name),
                    .where = b.table.where(),
                    .why = fmt::format("particles {:.3g} m apart near ({:.4g}, {:.4g}, {:.4g}) m, spacing {:.4g} m",
                                       overlap->distance, p[0], p[1], p[2], spacing),
                    .fix = "move one of them, cut it out with a 'difference', or align their edges to the spacing"});
}

}  // namespace

void note_names(const std::vector<Body>& bodies, std::map<std::string, int>& walls) {
  std::set<std::string> names;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].group == Group::wall) walls.emplace(bodies[b].name, static_cast<int>(b));
    if (!names.insert(bodies[b].name).second)
      bodies[b].table.fail("name", fmt::format("two bodies are named '{}'", bodies[b].name), {},
                           "give each its own name");
  }
}

template <int N>
void check_inside(const Table& root, const std::vector<Body>& bodies, const Domain<N>& domain) {
  for (const Body& body : bodies)
    for (const auto& p : body.points)
      if (!domain.contains(narrow<N>(p))) {
        const Table table = root.table("domain");
        throw InputError({.what = fmt::format("'{}' begins outside the domain", body.name),
                          .where = table.exists() ? table.where() : body.table.where(),
                          .why = fmt::format("a particle at ({:.4g}, {:.4g}, {:.4g}) m", p[0], p[1], p[2]),
                          .fix = "widen [domain] or move the body"});
      }
}

template <int N>
void check_overlaps(const std::vector<Body>& bodies, const Domain<N>& domain, double spacing) {
  const bool periodic = domain.any_periodic();
  std::vector<std::vector<Vec3>> wrapped;
  for (const Body& body : bodies) {
    check_period(body, domain);
    if (!periodic) continue;
    wrapped.push_back(body.points);
    for (Vec3& p : wrapped.back()) p = widen<N>(domain.wrapped(narrow<N>(p)));
  }
  const auto points = [&](std::size_t b) -> const std::vector<Vec3>& {
    return periodic ? wrapped[b] : bodies[b].points;
  };
  const auto closest = [&](const Body& a, const Body& b) {
    return (a.of_a_run || b.of_a_run ? 1e-6 : 0.5 * (1 - 1e-6)) * spacing;  // half a spacing is fine
  };
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].may_coincide)
      complain_of(check_overlap(points(b), closest(bodies[b], bodies[b])), bodies[b], bodies[b], spacing);
    for (std::size_t a = 0; a < b; ++a)
      if (bodies[a].group == Group::fluid)
        complain_of(check_overlap(points(a), points(b), closest(bodies[a], bodies[b])), bodies[a], bodies[b], spacing);
  }
}

template void check_inside(const Table&, const std::vector<Body>&, const Domain<1>&);
template void check_inside(const Table&, const std::vector<Body>&, const Domain<2>&);
template void check_inside(const Table&, const std::vector<Body>&, const Domain<3>&);

template void check_overlaps(const std::vector<Body>&, const Domain<1>&, double);
template void check_overlaps(const std::vector<Body>&, const Domain<2>&, double);
template void check_overlaps(const std::vector<Body>&, const Domain<3>&, double);

}  // namespace undine
