#include "undine/schemes/force_parts.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "flow.hpp"
#include "undine/schemes/weakly_compressible.hpp"

namespace undine {
namespace {

using namespace field;

/// A block of disordered fluid over two rows of wall particles.
template <class Change>
WeaklyCompressible<2> block_on_a_floor(Change&& change) {
  constexpr double spacing = 0.05, support = 2.6 * spacing;
  test::Random random(3);
  std::vector<Vec<2>> fluid, wall;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 8; ++j)
      fluid.push_back(Vec<2>{{(i + 0.5) * spacing, (j + 0.5) * spacing}} + random.vector<2>(0.1 * spacing));
  for (int i = -3; i < 13; ++i)
    for (int j = -3; j < 0; ++j) wall.push_back({{(i + 0.5) * spacing, (j + 0.5) * spacing}});
  auto store = test::empty_store<2>();
  test::add_particles(store, Group::fluid, fluid, spacing, support);
  test::add_particles(store, Group::wall, wall, spacing, support);
  for (auto& u : store.get<v>()) u = random.vector<2>(1);
  for (auto& density : store.get<rho>()) density *= random.between(0.998, 1.002);
  for (auto& viscosity : store.get<mu>()) viscosity = 5;
  auto options = test::liquid<2>(support);
  options.gravity = {{0, -9.81}};
  options.wall_density = walls::WallDensity::evolved;
  options.artificial = OneOf<terms::ArtificialViscosities>{};
  change(options);
  return {std::move(store), {{{-1, -1}}, {{2, 2}}, {}}, options};
}

template <class Change>
void expect_parts_to_sum_up(Change&& change, std::size_t least_parts) {
  const auto flow = block_on_a_floor(change);
  const auto a = flow.store().template get<acc>();
  const IndexRange fluid = flow.store().range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
    const auto parts = force_parts(flow, i);
    EXPECT_GE(parts.size(), least_parts);
    Vec<2> sum{};
    double largest = 0;
    for (const auto& part : parts) {
      sum += part.acc;
      largest = std::max(largest, norm(part.acc));
    }
    EXPECT_LE(norm(sum - a[i]), 1e-10 * largest) << "particle " << i;
  }
}

TEST(ForceParts, AddUpToTheAcceleration) {
  expect_parts_to_sum_up([](auto&) {}, 5);
}

TEST(ForceParts, KnowViscosityRepulsionFrictionAndImposedForces) {
  expect_parts_to_sum_up(
      [](auto& options) {
        options.viscosity = OneOf<terms::ViscosityForms>{};
        options.body_force = [](const Vec<2>& at, double) { return Vec<2>{{3 * at[1], 1}}; };
      },
      8);
  expect_parts_to_sum_up([](auto& options) { options.repulsion = terms::Repulsion{.D = 10, .r_0 = 0.05}; }, 6);
  expect_parts_to_sum_up(
      [](auto& options) {
        options.viscosity = OneOf<terms::ViscosityForms>{};
        options.wall_density = walls::WallDensity::extrapolated;
        options.wall_no_slip = true;
      },
      6);
  expect_parts_to_sum_up([](auto& options) { options.wall_friction = false; }, 4);
}

TEST(ForceParts, NameTheTermAndWhereItComesFrom) {
  const auto flow = block_on_a_floor([](auto&) {});
  std::vector<std::string> names;
  for (const auto& part : force_parts(flow, 0)) names.push_back(part.term);
  EXPECT_EQ(names, (std::vector<std::string>{"pressure (fluid)", "artificial viscosity (fluid)", "pressure (wall)",
                                             "artificial viscosity (wall)", "gravity"}));
}

}  // namespace
}  // namespace undine
