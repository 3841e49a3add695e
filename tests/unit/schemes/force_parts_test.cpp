#include "undine/schemes/force_parts.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "flow.hpp"
#include "gas_flow.hpp"
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

template <int N>
void expect_parts_to_sum_up(const Flow<N>& flow, std::size_t least_parts) {
  const auto a = flow.store().template get<acc>();
  const IndexRange fluid = flow.store().range(Group::fluid);
  for (std::size_t i = fluid.begin; i < fluid.end; i += 1 + fluid.size() / 60) {
    const auto parts = force_parts<N>(flow, i);
    EXPECT_GE(parts.size(), least_parts);
    Vec<N> sum{};
    double largest = 0;
    for (const auto& part : parts) {
      sum += part.acc;
      largest = std::max(largest, norm(part.acc));
    }
    EXPECT_LE(norm(sum - a[i]), 1e-10 * largest) << "particle " << i;
  }
}

template <class Change>
void expect_parts_to_sum_up(Change&& change, std::size_t least_parts) {
  expect_parts_to_sum_up<2>(block_on_a_floor(change), least_parts);
}

/// A periodic box of gas that shears and is compressed, with every term that accelerates it.
template <int N, class Change>
Gas<N> disordered_gas(int side, Change&& change) {
  const double spacing = 1.0 / side, support = 2.4 * spacing;
  auto store = test::gas_store(test::gas_box<N>(side, support, 11));
  for (auto& viscosity : store.template get<mu>()) viscosity = 0.2;
  auto options = test::gas<N>(support, spacing);
  options.artificial = OneOf<terms::GasViscosities>{};
  options.conductivity = terms::ConductivityPressure{};
  options.stress = OneOf<terms::StressForms>{};
  options.gravity[N - 1] = -1;
  options.body_force = [](const Vec<N>& at, double) { return 0.3 * at; };
  change(options);
  return {std::move(store), test::unit_box<N>(), options};
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

// Criterion: the parts' sum is the acceleration to 1e-10 of the largest, in gas by grad-h sums, by continuity with H of
// each pair, and in 1-D to 3-D.
TEST(ForceParts, OfAGasAddUpToItsAcceleration) {
  expect_parts_to_sum_up<1>(disordered_gas<1>(40, [](auto&) {}), 5);
  expect_parts_to_sum_up<2>(disordered_gas<2>(12, [](auto&) {}), 5);
  expect_parts_to_sum_up<3>(disordered_gas<3>(8, [](auto& options) { options.support_over_spacing = 1.8; }), 5);
  expect_parts_to_sum_up<2>(disordered_gas<2>(12,
                                              [](auto& options) {
                                                test::take_symmetric_forms(options);
                                                options.limiter = true;
                                                options.support.mean = Symmetrisation::gradients;
                                              }),
                            5);
}

// Criterion: the same where gradients are corrected and particles shifted, with walls that hold.
TEST(ForceParts, OfCorrectedGradientsAddUpToTheAcceleration) {
  expect_parts_to_sum_up(
      [](auto& options) {
        options.corrected_gradients = true;
        options.shifting = OneOf<terms::Shiftings>{};
        options.pressure.choose(terms::PressureForms::index<terms::PressureDifference>());
        options.viscosity = OneOf<terms::ViscosityForms>{};
        options.wall_density = walls::WallDensity::extrapolated;
        options.wall_no_slip = true;
      },
      9);
}

TEST(ForceParts, OfAGasNameItsTerms) {
  const auto flow = disordered_gas<2>(12, [](auto&) {});
  std::vector<std::string> names;
  for (const auto& part : force_parts<2>(flow, 0)) names.push_back(part.term);
  EXPECT_EQ(names, (std::vector<std::string>{"pressure (fluid)", "artificial viscosity (fluid)", "viscosity (fluid)",
                                             "gravity", "body force"}));
}

TEST(ForceParts, NameTheTermAndWhereItComesFrom) {
  const auto flow = block_on_a_floor([](auto&) {});
  std::vector<std::string> names;
  for (const auto& part : force_parts<2>(flow, 0)) names.push_back(part.term);
  EXPECT_EQ(names, (std::vector<std::string>{"pressure (fluid)", "artificial viscosity (fluid)", "pressure (wall)",
                                             "artificial viscosity (wall)", "gravity"}));
}

}  // namespace
}  // namespace undine
