#include "undine/schemes/gas_sweeps.hpp"

#include <string>

#include <gtest/gtest.h>

#include "unit/terms/gas_pairs.hpp"

// The sweeps of gases, in which each particle has its own H, against sums pair by pair: supports that differ by more
// than a factor of two, so that lists and loops must not miss a pair that only one of both reaches.

namespace undine {
namespace {

using test::GasFields;
using test::GasParticle;
using test::in_every_dimension;

/// A crowd with its neighbours, and the same particles for sums by hand.
template <int N>
class Bench {
 public:
  Bench() : crowd_(make()), neighbours_(crowd_.domain, {}) {
    neighbours_.build(crowd_.store, crowd_.support);
    for (std::size_t i = 0; i < crowd_.store.size(); ++i) {
      GasParticle<N> a{};
      GasFields::for_each([&]<class F>(F) { F::of(a) = crowd_.store.template get<F>()[i]; });
      particles_.push_back(a);
    }
  }
  Store<N>& store() { return crowd_.store; }
  std::vector<GasParticle<N>> particles() const { return particles_; }
  KernelChoice kernel() const { return KernelChoice::of<QuinticSpline>(); }

  template <class Sweep>
  void run(Sweep& sweep, PairPrecision precision) {
    Support support{.uniform = crowd_.support, .kappa = test::gas_kappa, .per_particle = true};
    sweep.run({crowd_.store, neighbours_, crowd_.domain, support, {kernel(), kernel(), kernel()}, 1000},
              {BackendKind::threads, precision});
  }

 private:
  static test::Crowd<N> make() {
    auto crowd = test::make_crowd<N>({.side = N == 1   ? 60
                                              : N == 2 ? 14
                                                       : 8,
                                      .disorder = 0.3,
                                      .wall_layers = 0,
                                      .support = 3.6});
    test::Random random(11);
    for (auto& H : crowd.store.template get<field::h>()) H = random.between(0.4, 1) * crowd.support;
    return crowd;
  }
  test::Threads one_{1};
  test::Crowd<N> crowd_;
  Neighbours<N> neighbours_;
  std::vector<GasParticle<N>> particles_;
};

/// Largest difference of any field that the term adds, relative to the largest of that field.
template <int N, class Term, class Sweep>
double difference(Bench<N>& bench, Sweep& sweep, const Term& term, PairPrecision precision) {
  bench.run(sweep, precision);
  auto expected = bench.particles();
  constexpr bool both = std::is_same_v<Sweep, typename GasSweeps<N>::Force>;
  test::sum_all<N>(expected, bench.kernel(), term, both ? test::Neighbourhood::either : test::Neighbourhood::mean);
  double worst = 0;
  Term::adds::for_each([&]<class F>(F) {
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const auto& one = F::of(expected[i]);
      const auto& other = bench.store().template get<F>()[i];
      if constexpr (F::info.rank == Rank::scalar) {
        largest = std::max(largest, std::abs(one));
        apart = std::max(apart, std::abs(one - other));
      } else {
        largest = std::max(largest, norm(one));
        apart = std::max(apart, norm(one - other));
      }
    }
    EXPECT_GT(largest, 0) << F::info.name;
    worst = std::max(worst, apart / largest);
  });
  return worst;
}

template <int N, class Term, class Sweep>
void check(Bench<N>& bench, Sweep& sweep, const Term& term) {
  const double in_double = difference<N>(bench, sweep, term, PairPrecision::double_precision);
  const double in_mixed = difference<N>(bench, sweep, term, PairPrecision::mixed);
  EXPECT_LE(in_double, 1e-12) << Term::info.name << ' ' << N;
  EXPECT_LE(in_mixed, 2e-5) << Term::info.name << ' ' << N;
  std::printf("    %s in %d-D: double %.2g, mixed %.2g off\n", Term::info.name.data(), N, in_double, in_mixed);
}

// Criterion: each term of the force sweep, alone, within 1e-12 in double and 2e-5 mixed of the sum pair by pair.
TEST(GasSweeps, ForceTermsAgreeWithSumsPairByPair) {
  in_every_dimension([]<int N>() {
    using Sweeps = GasSweeps<N>;
    Bench<N> bench;
    typename Sweeps::Force sweep("force", Group::fluid);
    const auto none = [&] { std::apply([](auto&... use) { ((use.active = false), ...); }, sweep.uses()); };
    const auto choose = [&]<std::size_t place, class List>(std::integral_constant<std::size_t, place>, List) {
      List::for_each([&]<class Term>(const Term& term) {
        none();
        auto& use = sweep.template use<place>();
        use.active = true;
        use.term = OneOf<List>(term);
        check<N>(bench, sweep, term);
      });
    };
    choose(std::integral_constant<std::size_t, Sweeps::pressure>{}, terms::GasPressureForms{});
    choose(std::integral_constant<std::size_t, Sweeps::energy>{}, terms::EnergyForms{});
    choose(std::integral_constant<std::size_t, Sweeps::artificial>{}, terms::GasViscosities{});
    choose(std::integral_constant<std::size_t, Sweeps::conductivity>{}, terms::Conductivities{});
    choose(std::integral_constant<std::size_t, Sweeps::stress>{}, terms::StressForms{});
    none();
    sweep.template use<Sweeps::signal>().active = true;
    check<N>(bench, sweep, terms::SignalSpeed{});
  });
}

// Criterion: density sums take the target's own H, to 1e-12 in double and 2e-5 mixed.
TEST(GasSweeps, DensitySumsTakeTheTargetsSupport) {
  in_every_dimension([]<int N>() {
    Bench<N> bench;
    typename GasSweeps<N>::Density sweep("density", Group::fluid);
    terms::GradHDensities::for_each([&]<class Term>(const Term& term) {
      sweep.template use<0>().term = OneOf<terms::GradHDensities>(term);
      check<N>(bench, sweep, term);
    });
  });
}

}  // namespace
}  // namespace undine
