#include <numbers>

#include <gtest/gtest.h>

#include "unit/schemes/flow.hpp"

// Densities that are carried by continuity and summed anew now and then: what they reproduce, and what that does to
// energy, to motion and to a run that goes on. And that densities which are summed at each step see compression.

namespace undine {
namespace {

using namespace field;
using integrators::Leapfrog;
using test::PeriodicSquare;
using test::Threads;

constexpr double spacing = 0.1, support = 0.3;

template <class Filter>
ChoiceOf<terms::DensityFilters> filter_of(double every) {
  Filter filter;
  filter.every = every;
  return filter;
}

/// A block of side^N particles off their lattice, of masses that differ by up to a half.
template <int N>
Store<N> block(int side) {
  test::Random random(7);
  std::vector<Vec<N>> at;
  Vec<N> cell{};
  for (bool more = true; more;) {
    at.push_back(spacing * cell + random.vector<N>(0.2 * spacing));
    more = false;
    for (int k = 0; k < N && !more; ++k) {
      cell[k] += 1;
      more = cell[k] < side;
      if (!more) cell[k] = 0;
    }
  }
  auto store = test::empty_store<N>();
  test::add_particles(store, Group::fluid, at, spacing, support);
  for (auto& mass : store.template get<m>()) mass *= random.between(0.75, 1.25);
  return store;
}

/// Largest change of rho = 1000 + slope (x + y + z) by one sum anew, relative, over the block and its boundary.
template <int N, class Filter>
double change_of_linear_field(double slope) {
  auto store = block<N>(N == 3 ? 7 : 12);
  const auto wanted = [&](const Vec<N>& at) {
    double sum = 0;
    for (int k = 0; k < N; ++k) sum += at[k];
    return 1000 + slope * sum;
  };
  for (std::size_t i = 0; i < store.size(); ++i) store.template get<rho>()[i] = wanted(store.template get<x>()[i]);
  auto options = test::liquid<N>(support);
  options.density_filter = filter_of<Filter>(1);
  WeaklyCompressible<N> flow(std::move(store), Domain<N>::unbounded(), options);
  flow.smooth();
  double worst = 0;
  for (std::size_t i = 0; i < flow.store().size(); ++i)
    worst =
        std::max(worst, std::abs(flow.store().template get<rho>()[i] / wanted(flow.store().template get<x>()[i]) - 1));
  return worst;
}

// Criterion: on disordered particles of unequal mass, boundary and corners included, RKPM leaves linear densities as
// they are to 1e-10, Shepard's mean uniform ones; of linear ones, 5 kg/m^3 over the support along each axis, the mean
// changes a tenth of that or more at the boundary.
TEST(DensityFilter, ReproducesWhatItPromises) {
  const Threads one(1);
  const auto check = []<int N>(std::integral_constant<int, N>) {
    const double slope = 5 / support;
    const double rkpm = change_of_linear_field<N, terms::FilterRkpm>(slope);
    const double uniform = change_of_linear_field<N, terms::FilterShepard>(0);
    const double shepard = change_of_linear_field<N, terms::FilterShepard>(slope);
    std::printf("    %d-D: RKPM %.2g, Shepard %.2g of a uniform field, %.2g of a linear one\n", N, rkpm, uniform,
                shepard);
    EXPECT_LE(rkpm, 1e-10);
    EXPECT_LE(uniform, 1e-10);
    EXPECT_GE(shepard, 0.1 * 5 / 1000);
  };
  check(std::integral_constant<int, 1>{});
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 3>{});
}

// Criterion: where neighbours do not span space, a row in a plane, the density is Shepard's mean; a lone particle keeps
// its own. Both to 1e-12.
TEST(DensityFilter, FallsBackToTheMeanWhereParticlesAreFew) {
  const Threads one(1);
  const auto summed = []<class Filter>(Filter) {
    auto store = test::empty_store<2>();
    std::vector<Vec<2>> at;
    for (int i = 0; i < 6; ++i) at.push_back({{i * spacing, 0}});
    at.push_back({{5, 5}});
    test::add_particles(store, Group::fluid, at, spacing, support);
    for (std::size_t i = 0; i < at.size(); ++i) store.get<rho>()[i] = 1000 + 3.0 * static_cast<double>(i * i);
    auto options = test::liquid<2>(support);
    options.density_filter = filter_of<Filter>(1);
    WeaklyCompressible<2> flow(std::move(store), Domain<2>::unbounded(), options);
    flow.smooth();
    std::vector<double> densities(at.size());
    for (std::size_t i = 0; i < at.size(); ++i)
      densities[static_cast<std::size_t>(flow.store().ids()[i])] = flow.store().get<rho>()[i];
    return densities;
  };
  const auto rkpm = summed(terms::FilterRkpm{}), shepard = summed(terms::FilterShepard{});
  for (std::size_t i = 0; i < rkpm.size(); ++i) EXPECT_NEAR(rkpm[i], shepard[i], 1e-12 * shepard[i]);
  EXPECT_NEAR(rkpm.back(), 1000 + 3.0 * 36, 1e-9);
}

// Criterion: what a sum anew takes from the elastic energy stands in `diffusion`, so that the total keeps all but
// rounding, 1e-12 of what was taken away; and noise of the density, even over all, loses half or more of its size.
TEST(DensityFilter, BooksWhatItTakesAndTakesNoise) {
  const Threads one(1);
  const PeriodicSquare square;
  auto options = test::liquid<2>(square.support);
  options.density_filter = filter_of<terms::FilterRkpm>(1);
  WeaklyCompressible<2> flow(square.store(), square.domain(), options);
  const auto noise = [&] {
    double sum = 0;
    for (const double density : flow.store().get<rho>()) sum += sq(density / 1000 - 1);
    return std::sqrt(sum / static_cast<double>(flow.store().size()));
  };
  const Energies before = flow.energies();
  const double noise_before = noise();
  flow.smooth();
  const Energies after = flow.energies();
  EXPECT_GT(after.ledger.diffusion, 0.5 * before.elastic);
  EXPECT_NEAR(after.total(), before.total(), 1e-12 * before.total());
  EXPECT_LE(noise(), 0.5 * noise_before);
}

/// A standing wave in a periodic line of 40 particles, c = 20 m/s, after a full period: the amplitude of its velocity
/// over that at the start.
double amplitude_after_a_period(std::optional<ChoiceOf<terms::DensityFilters>> filter) {
  constexpr int particles = 40;
  constexpr double k = 2 * std::numbers::pi, dp = 1.0 / particles, c_0 = 20;
  auto store = test::empty_store<1>();
  std::vector<Vec<1>> at;
  for (int i = 0; i < particles; ++i) at.push_back({{(i + 0.5) * dp}});
  test::add_particles(store, Group::fluid, at, dp, 2.6 * dp);
  for (std::size_t i = 0; i < particles; ++i) store.get<v>()[i][0] = 0.02 * std::sin(k * at[i][0]);
  auto options = test::liquid<1>(2.6 * dp);
  options.density_filter = std::move(filter);
  WeaklyCompressible<1> flow(std::move(store), Domain<1>{{{0}}, {{1}}, {true}}, options);
  constexpr int steps = 100;  // c dt = 0.4 dp
  test::run_steps<Leapfrog>(flow, steps, 1 / c_0 / steps);
  double sum = 0;
  for (std::size_t i = 0; i < particles; ++i)
    sum += flow.store().get<v>()[i][0] * std::sin(k * flow.store().get<x>()[i][0]) * 2 / particles;
  return sum / 0.02;
}

// Criterion: sound goes through a filtered density. A sum anew smooths a wave by the kernel's second moment, 2/21 H^2
// for Wendland C2 on a line, half of which the velocity loses: over a period its amplitude falls by
// exp(-(steps/every) k^2/4 2/21 H^2), to a tenth of the loss, with either filter.
TEST(DensityFilter, LetsSoundPass) {
  const Threads one(1);
  const double without = amplitude_after_a_period({});
  const auto check = [&](double every, const ChoiceOf<terms::DensityFilters>& filter) {
    const double H = 2.6 / 40, k = 2 * std::numbers::pi;
    const double wanted = std::exp(-100 / every * sq(k) / 4 * (2.0 / 21) * sq(H));
    const double kept = amplitude_after_a_period(filter) / without;
    std::printf("    %s, every %g steps: %.4f, expected %.4f\n", std::string(filter.info().name).c_str(), every, kept,
                wanted);
    EXPECT_NEAR(kept, wanted, 0.1 * (1 - wanted));
  };
  check(20, filter_of<terms::FilterRkpm>(20));
  check(20, filter_of<terms::FilterShepard>(20));
  check(1, filter_of<terms::FilterRkpm>(1));
}

// Criterion: particles that stand 2 % closer along each of two axes than at the reference density have a density that
// is higher by 1/0.98^2, to 1e-3, by either sum.
TEST(SummedDensity, SeesCompression) {
  const Threads one(1);
  for (const auto form : {DensityForm::summation, DensityForm::normalised}) {
    PeriodicSquare square;
    auto options = test::liquid<2>(square.support);
    options.density = form;
    std::vector<Vec<2>> at;
    const double closer = 0.9 * square.spacing;
    for (int i = 0; i < square.side; ++i)
      for (int j = 0; j < square.side; ++j) at.push_back({{(i + 0.5) * closer, (j + 0.5) * closer}});
    auto store = test::empty_store<2>();
    test::add_particles(store, Group::fluid, at, square.spacing, square.support);
    const double side = square.side * closer;
    WeaklyCompressible<2> flow(std::move(store), Domain<2>{{{0, 0}}, {{side, side}}, {true, true}}, options);
    for (const double density : flow.store().get<rho>()) EXPECT_NEAR(density * sq(0.9), 1000, 20);
  }
}

// Criterion: a run that goes on from a copied store and memory, between two sums anew, has the bits of one that never
// stopped.
TEST(DensityFilter, GoesOnFromMemory) {
  const Threads one(1);
  const PeriodicSquare square;
  auto options = test::liquid<2>(square.support);
  options.density_filter = filter_of<terms::FilterRkpm>(7);
  WeaklyCompressible<2> whole(square.store(), square.domain(), options);
  test::run_steps<Leapfrog>(whole, 10, 1e-4);
  WeaklyCompressible<2> second(Store<2>(whole.store()), square.domain(), options, whole.memory());
  test::run_steps<Leapfrog>(whole, 10, 1e-4);
  test::run_steps<Leapfrog>(second, 10, 1e-4);
  EXPECT_EQ(whole.memory(), second.memory());
  for (std::size_t i = 0; i < whole.store().size(); ++i)
    EXPECT_EQ(whole.store().get<rho>()[i], second.store().get<rho>()[i]);
}

}  // namespace
}  // namespace undine
