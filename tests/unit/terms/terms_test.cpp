#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "undine/engine/update.hpp"
#include "undine/schemes/particle_rules.hpp"
#include "undine/schemes/presets.hpp"
#include "undine/terms/catalogue.hpp"
#include "unit/engine/crowd.hpp"
#include "unit/engine/every_term.hpp"

// Properties of the terms, generated from the lists of terms/catalogue.hpp; sums run in the engine, in double.

namespace undine {
namespace {

using namespace field;
using test::Crowd;
using test::EveryTerm;
using test::make_crowd;
using test::Random;

/// Particles with their neighbours, on which terms are evaluated.
template <int N>
class Bench {
 public:
  explicit Bench(const Crowd<N>& made, KernelChoice kernel = {})
      : crowd_(made), neighbours_(made.domain, {}), kernel_(kernel) {
    neighbours_.build(crowd_.store, crowd_.support);
  }

  Store<N>& store() { return crowd_.store; }
  template <class Tag>
  auto get() {
    return crowd_.store.template get<Tag>().first(size());
  }
  std::size_t size() const { return crowd_.store.range(Group::fluid).size(); }

  template <class Term>
  void run(const Term& term = {}) {
    test::use_only<Term>(sweep_, term);
    sweep_.run(
        {crowd_.store, neighbours_, crowd_.domain, Support{.uniform = crowd_.support}, {kernel_, kernel_, kernel_}},
        {BackendKind::threads, PairPrecision::double_precision});
  }
  /// Calls f(i) for each particle further than the support from the sides of the box.
  template <class F>
  void for_bulk(F&& f) {
    for (std::size_t i = 0; i < size(); ++i) {
      bool inside = true;
      for (int k = 0; k < N; ++k) {
        const double at = get<x>()[i][k];
        inside = inside && at > crowd_.domain.low[k] + 1.1 * crowd_.support &&
                 at < crowd_.domain.high[k] - 1.1 * crowd_.support;
      }
      if (inside) f(i);
    }
  }
  /// Sum of f(i) over all particles, and of its magnitude.
  template <class F>
  std::pair<double, double> total(F&& f) const {
    double sum = 0, size_of = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      const double one = f(i);
      sum += one;
      size_of += std::abs(one);
    }
    return {sum, size_of};
  }

 private:
  test::Threads one_{1};
  Crowd<N> crowd_;
  Neighbours<N> neighbours_;
  KernelChoice kernel_;
  EveryTerm<N> sweep_{"test", Group::fluid};
};

template <class F>
void in_each_dimension(F f) {
  f.template operator()<1>();
  f.template operator()<2>();
  f.template operator()<3>();
}

template <int N>
Crowd<N> fluid_crowd(double disorder = 0.3, double support = 2.6) {
  return make_crowd<N>({.side = N == 1   ? 50
                                : N == 2 ? 16
                                         : 10,
                        .disorder = disorder,
                        .wall_layers = 0,
                        .support = support});
}

/// A term with parameters at which it does something in every test.
template <class Term>
Term example() {
  Term term{};
  if constexpr (requires { term.beta; }) term.beta = 2;
  if constexpr (requires { term.gravity; }) term.gravity = {{0, -9.81, 0}};
  if constexpr (requires { term.r_0; }) term.r_0 = 0.015;
  if constexpr (requires { term.separation; }) {
    term.separation = 50;
    term.reach = 0.012;
  }
  return term;
}

// ---- Invariance
// ------------------------------------------------------------------------------------------------------

/// Results of a term by particle id, one array of numbers per field.
template <int N, class Term>
std::vector<std::vector<double>> by_id(Bench<N>& bench, const Term& term) {
  bench.run(term);
  std::vector<std::vector<double>> results;
  Term::adds::for_each([&]<class F>(F) {
    const std::size_t n = F::info.components(N);
    std::vector<double> values(bench.size() * n);
    for (std::size_t i = 0; i < bench.size(); ++i)
      for (std::size_t k = 0; k < n; ++k) values[bench.store().ids()[i] * n + k] = bench.store().raw(F::id)[i * n + k];
    results.push_back(std::move(values));
  });
  return results;
}

/// Largest difference relative to the largest magnitude, of the worst field.
double difference(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  double worst = 0;
  for (std::size_t f = 0; f < a.size(); ++f) {
    double largest = 0, apart = 0;
    for (std::size_t k = 0; k < a[f].size(); ++k) {
      largest = std::max(largest, std::abs(a[f][k]));
      apart = std::max(apart, std::abs(a[f][k] - b[f][k]));
    }
    EXPECT_GT(largest, 0);
    worst = std::max(worst, apart / largest);
  }
  return worst;
}

// Criterion: a velocity common to all changes no rate by more than 1e-12.
TEST(Terms, AreGalileanInvariant) {
  in_each_dimension([]<int N>() {
    const auto still = fluid_crowd<N>();
    auto moving = still;
    for (auto& u : moving.store.template get<v>())
      for (int k = 0; k < N; ++k) u[k] += 3 - k;
    Bench<N> a(still), b(moving);
    test::for_each_term([&]<class Term>(Term) {
      const auto term = example<Term>();
      EXPECT_LE(difference(by_id(a, term), by_id(b, term)), 1e-12) << Term::info.name << ' ' << N;
    });
  });
}

// Criterion: a shift by a hundred spacings changes no rate by more than 1e-11 (positions lose two digits).
TEST(Terms, AreInvariantUnderTranslation) {
  in_each_dimension([]<int N>() {
    const auto here = fluid_crowd<N>();
    auto there = here;
    for (auto& at : there.store.template get<x>())
      for (int k = 0; k < N; ++k) at[k] += 1.234 + 0.1 * k;
    Bench<N> a(here), b(there);
    test::for_each_term([&]<class Term>(Term) {
      const auto term = example<Term>();
      EXPECT_LE(difference(by_id(a, term), by_id(b, term)), 1e-11) << Term::info.name << ' ' << N;
    });
  });
}

Vec<2> turned(const Vec<2>& a) { return {{-a[1], a[0]}}; }
double turned(double a) { return a; }
Vec<2, Vec<2>> turned(const Vec<2, Vec<2>>& t) {  // R t R^T
  const Vec<2, Vec<2>> rows{{turned(t[0]), turned(t[1])}};
  return {{-rows[1], rows[0]}};
}

// Criterion: with all vectors turned by 90 degrees, rates turn with them, to 1e-13.
TEST(Terms, TurnWithTheirVectors) {
  const auto straight = fluid_crowd<2>();
  auto askew = straight;
  const auto turn = [&]<class F>(F) {
    for (auto& value : askew.store.get<F>()) value = turned(value);
  };
  Fields<x, v, v_friction, grad_rho_l, acc, stress>::for_each(turn);
  Bench<2> a(straight), b(askew);
  test::for_each_term([&]<class Term>(Term) {
    auto term = example<Term>();
    auto expected = by_id(a, term);
    std::size_t f = 0;
    Term::adds::for_each([&]<class F>(F) {
      using Value = typename F::template value<2, double>;
      auto* values = reinterpret_cast<Value*>(expected[f++].data());
      for (std::size_t i = 0; i < a.size(); ++i) values[i] = turned(values[i]);
    });
    if constexpr (requires { term.gravity; }) term.gravity = {{9.81, 0, 0}};
    EXPECT_LE(difference(expected, by_id(b, term)), 1e-13) << Term::info.name;
  });
}

// ---- Single pairs
// ----------------------------------------------------------------------------------------------------

template <class Term>
struct TwoParticles {
  using Row = typename Term::reads::template Row<2, double>;
  Row a, b;
  Vec<2> dx;
  double support = 0.026;
  KernelChoice kernel{};

  explicit TwoParticles(Random& random) : dx(random.vector<2>(0.015)) {
    for (Row* row : {&a, &b}) {
      const auto set = [&]<class F>(F) {
        auto& value = F::of(*row);
        if constexpr (F::info.rank == Rank::vector) {
          value = random.vector<2>(1);
        } else {
          value = random.between(0.5, 2) * (F::id == rho::id ? 1000 : F::id == p::id ? 1e4 : 1);
        }
      };
      Term::reads::for_each(set);
    }
  }
  Pair<2, double> pair(double sign) const {
    Pair<2, double> ab;
    ab.dx = sign * dx;
    ab.r_sq = norm_sq(dx);
    ab.r = norm(dx);
    ab.support = support;
    ab.h = support / 2;
    ab.inv_r_sq = 1 / (ab.r_sq + 0.01 * sq(ab.h));
    if constexpr (Term::reads::template has<rho>) ab.inv_rho = 2 / (a.rho + b.rho);
    ab.w = kernel.w<2>(ab.r / support) / sq(support);
    ab.grad_w = ab.dx * (kernel.slope_over_R<2>(ab.r / support) / sq(sq(support)));
    ab.inside = ab.r < support;
    ab.kernel = &kernel;
    return ab;
  }
  Vec<2> force_on_a(const Term& term) const { return a.m * term(a, b, pair(1)).acc; }
  Vec<2> force_on_b(const Term& term) const { return b.m * term(b, a, pair(-1)).acc; }
};

template <class F>
void for_each_force(F f) {
  terms::PressureForms::for_each(f);
  terms::ViscosityForms::for_each(f);
  terms::ArtificialViscosities::for_each(f);
}

/// Largest |force on a + force on b| relative to the forces, over random pairs.
template <class Term>
double imbalance() {
  Random random(1);
  double worst = 0;
  for (int k = 0; k < 1000; ++k) {
    const TwoParticles<Term> two(random);
    const auto term = example<Term>();
    const Vec<2> on_a = two.force_on_a(term), on_b = two.force_on_b(term);
    const double size = norm(on_a) + norm(on_b);
    if (size > 0) worst = std::max(worst, norm(on_a + on_b) / size);
  }
  return worst;
}

// Criterion: m_a acc_ab = -m_b acc_ba to 1e-14 for all forms but those that say they break it, where the imbalance
// exceeds 1 %.
TEST(Terms, ForcesOfAPairAreOppositeButForTheUnsymmetricForms) {
  int pressures = 0;
  for_each_force([&]<class Term>(Term) {
    constexpr bool unsymmetric = std::is_same_v<Term, terms::PressurePlain> ||
                                 std::is_same_v<Term, terms::PressureDifference> ||
                                 std::is_same_v<Term, terms::ViscosityLaminar>;
    const double seen = imbalance<Term>();
    if (unsymmetric) {
      EXPECT_GE(seen, 0.01) << Term::info.name;
      std::printf("    %s: forces of a pair are unbalanced by up to %.3g of their sum\n", Term::info.name.data(), seen);
    } else {
      EXPECT_LE(seen, 1e-14) << Term::info.name;
    }
    ++pressures;
  });
  EXPECT_GT(pressures, 0);
}

// Criterion: |dx x force| <= 1e-14 |dx| |force| for pressure forms and artificial viscosities; laminar ones act along
// the velocity.
TEST(Terms, PressureAndArtificialViscosityActAlongTheLineOfThePair) {
  const auto central = []<class Term>(Term) {
    Random random(2);
    for (int k = 0; k < 1000; ++k) {
      const TwoParticles<Term> two(random);
      const Vec<2> f = two.force_on_a(example<Term>());
      EXPECT_LE(std::abs(two.dx[0] * f[1] - two.dx[1] * f[0]), 1e-14 * norm(two.dx) * norm(f)) << Term::info.name;
    }
  };
  terms::PressureForms::for_each(central);
  terms::ArtificialViscosities::for_each(central);
}

// Criterion: |sum m x cross acc| <= 1e-13 sum m |x| |acc| on a disordered crowd.
TEST(Terms, SymmetricCentralForcesHaveNoTorque) {
  Bench<2> bench(fluid_crowd<2>());
  const auto torque = [&]<class Term>(Term) {
    if (std::is_same_v<Term, terms::PressurePlain> || std::is_same_v<Term, terms::PressureDifference>) return;
    bench.run(example<Term>());
    const auto at = bench.get<x>();
    const auto a = bench.get<acc>();
    const auto [sum, size] =
        bench.total([&](std::size_t i) { return bench.get<m>()[i] * (at[i][0] * a[i][1] - at[i][1] * a[i][0]); });
    EXPECT_LE(std::abs(sum), 1e-13 * size) << Term::info.name;
  };
  terms::PressureForms::for_each(torque);
  terms::ArtificialViscosities::for_each(torque);
}

// ---- Pairs
// ---------------------------------------------------------------------------------------------------------

/// Force per mass that pushes apart two particles of one spacing, r apart, without pressure.
template <int N>
double push_apart(const terms::PressureSymmetric& term, double r, double spacing) {
  const double support = 2.6 * spacing;
  const KernelChoice kernel{};
  terms::PressureSymmetric::reads::Row<N, double> row{};
  row.m = 1000 * std::pow(spacing, N);
  row.rho = 1000;
  Pair<N, double> ab{};
  ab.dx[0] = r;
  ab.r = r;
  ab.r_sq = sq(r);
  ab.inv_rho = 1 / row.rho;
  ab.grad_w = ab.dx * (kernel.slope_over_R<N>(r / support) / std::pow(support, N + 2));
  return term(row, row, ab).acc[0];
}

// Criterion: the artificial pressure of `symmetric` pushes apart below its reach, by the number of its formula with the
// slope of Wendland's C2 in 2-D written out (1e-14), and is zero at and beyond its reach.
TEST(Terms, SymmetricKeepsPairsApartBelowItsReachOnly) {
  terms::PressureSymmetric term;
  term.separation = 80;
  term.reach = 0.005;
  for (const double r : {0.001, 0.0025, 0.0049}) {
    const double H = 0.026, R = r / H, pi = std::acos(-1.0);
    const double slope = -140 / (pi * H * H * H) * R * (1 - R) * (1 - R) * (1 - R);
    const double expected = -0.1 * (80.0 / 1000) * sq(1 - sq(r / 0.005)) * slope;
    EXPECT_GT(expected, 0);
    EXPECT_NEAR(push_apart<2>(term, r, 0.01) / expected, 1, 1e-14) << r;
  }
  for (const double r : {0.005, 0.00501, 0.01, 0.02}) EXPECT_EQ(push_apart<2>(term, r, 0.01), 0) << r;
}

// Criterion: with the strength of the preset `recommended`, two particles without pressure that meet at 0.7 of the
// expected speed are turned back before they coincide (0.1 spacings), in each dimension: the work per mass of a push on
// both, from its reach to there, exceeds (0.7 U)^2/4.
TEST(Terms, TheRecommendedSeparationStopsPairsThatMeet) {
  in_each_dimension([]<int N>() {
    const double U = 3, spacing = 0.01;
    terms::PressureSymmetric term;
    term.separation = presets::Recommended::separation * sq(U);
    term.reach = presets::Recommended::reach * spacing;
    double work = 0;
    const double dr = 1e-4 * spacing;
    for (double r = 0.1 * spacing + dr / 2; r < term.reach; r += dr) work += dr * push_apart<N>(term, r, spacing);
    EXPECT_GT(work, sq(0.7 * U) / 4) << N;
    std::printf("    %d-D: up to %.3g of the expected speed\n", N, 2 * std::sqrt(work) / U);
  });
}

// ---- Energy
// ----------------------------------------------------------------------------------------------------------

/// Largest sum m v.acc relative to its parts, over random velocities; negative where the term always dissipates.
template <int N, class Term>
double largest_power(KernelChoice kernel) {
  Bench<N> bench(fluid_crowd<N>(), kernel);
  Random random(4);
  double largest = -1;
  for (int trial = 0; trial < 10; ++trial) {
    for (auto& u : bench.template get<v>()) u = random.vector<N>(1);
    bench.run(example<Term>());
    const auto [sum, size] = bench.total([&](std::size_t i) {
      return bench.template get<m>()[i] * dot(bench.template get<v>()[i], bench.template get<acc>()[i]);
    });
    largest = std::max(largest, sum / size);
  }
  return largest;
}

// Criterion: sum m v.acc < 0 for every viscosity with the default kernel, on random velocities.
TEST(Terms, ViscositiesDissipate) {
  in_each_dimension([]<int N>() {
    const auto dissipates = []<class Term>(Term) {
      const double power = largest_power<N, Term>({});
      EXPECT_LT(power, 0) << Term::info.name << ' ' << N;
      RecordProperty(std::string(Term::info.name) + std::to_string(N), std::to_string(power));
    };
    terms::ViscosityForms::for_each(dissipates);
    terms::ArtificialViscosities::for_each(dissipates);
  });
}

/// |sum m v.acc + m p/rho^2 drho| relative to its parts.
template <int N, class Pressure, class Density>
double unmatched_work() {
  Bench<N> bench(fluid_crowd<N>());
  bench.template run<Pressure>();
  bench.template run<Density>();
  // The sweep of one term leaves zero in what the others add to: each needs its own results kept.
  const std::vector<double> rates(bench.template get<drho>().begin(), bench.template get<drho>().end());
  bench.template run<Pressure>();
  double sum = 0, size = 0;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    const double mass = bench.template get<m>()[i];
    const double moved = mass * dot(bench.template get<v>()[i], bench.template get<acc>()[i]);
    const double stored = mass * bench.template get<p>()[i] / sq(bench.template get<rho>()[i]) * rates[i];
    sum += moved + stored;
    size += std::abs(moved) + std::abs(stored);
  }
  return std::abs(sum) / size;
}

// Criterion: pressure work and compression cancel to 1e-13 for the two matching pairs of forms, and for no other (1e-4
// and more).
TEST(Terms, MatchingPressureAndDensityFormsConserveEnergy) {
  in_each_dimension([]<int N>() {
    terms::PressureForms::for_each([]<class Pressure>(Pressure) {
      terms::ContinuityForms::for_each([]<class Density>(Density) {
        constexpr bool match =
            (std::is_same_v<Pressure, terms::PressureSymmetric> && std::is_same_v<Density, terms::Continuity>) ||
            (std::is_same_v<Pressure, terms::PressureSum> && std::is_same_v<Density, terms::ContinuityVolume>);
        const double left = unmatched_work<N, Pressure, Density>();
        if (match)
          EXPECT_LE(left, 1e-13) << Pressure::info.name << " with " << Density::info.name << ' ' << N;
        else
          EXPECT_GE(left, 1e-4) << Pressure::info.name << " with " << Density::info.name << ' ' << N;
      });
    });
  });
}

// ---- Density
// ---------------------------------------------------------------------------------------------------------

// Criterion: drho/dt = -N k rho within 3 % in the bulk of a lattice that expands by v = k x.
TEST(Terms, ContinuityFollowsAUniformExpansion) {
  in_each_dimension([]<int N>() {
    Bench<N> bench(fluid_crowd<N>(0));
    const double k = 2.5;
    for (std::size_t i = 0; i < bench.size(); ++i) {
      bench.template get<v>()[i] = k * bench.template get<x>()[i];
      bench.template get<rho>()[i] = 1000;
      bench.template get<m>()[i] = 1000 * std::pow(0.01, N);
    }
    terms::ContinuityForms::for_each([&]<class Term>(Term) {
      bench.template run<Term>();
      int seen = 0;
      bench.for_bulk([&](std::size_t i) {
        ++seen;
        EXPECT_NEAR(bench.template get<drho>()[i] / (-N * k * 1000), 1, 0.03) << Term::info.name << ' ' << N;
      });
      EXPECT_GT(seen, 0);
    });
  });
}

// Criterion: the summed density is within 2 % of the lattice's, and the Shepard sum is their ratio.
TEST(Terms, SummationGivesTheDensityOfALattice) {
  in_each_dimension([]<int N>() {
    Bench<N> bench(fluid_crowd<N>(0));
    for (std::size_t i = 0; i < bench.size(); ++i) {
      bench.template get<rho>()[i] = 800;
      bench.template get<m>()[i] = 800 * std::pow(0.01, N);
    }
    bench.template run<terms::Summation>();
    const std::vector<double> density(bench.template get<rho_sum>().begin(), bench.template get<rho_sum>().end());
    bench.template run<terms::ShepardSum>();
    bench.for_bulk([&](std::size_t i) {
      EXPECT_NEAR(density[i] / 800, 1, 0.02) << N;
      EXPECT_NEAR(bench.template get<w_sum>()[i], density[i] / 800, 1e-13) << N;
    });
  });
}

// Criterion: the volume-weighted sum of the rates, sum (m_a/rho_a) drho_a, is zero to 1e-13: every diffusive flux of a
// pair, V_a V_b h (c_a + c_b) (difference) F, changes sign with the pair, whatever the masses, densities and sound
// speeds.
TEST(Terms, DiffusionConservesTheVolumeWeightedSum) {
  in_each_dimension([]<int N>() {
    Bench<N> bench(fluid_crowd<N>());
    terms::DiffusionForms::for_each([&]<class Term>(Term) {
      bench.run(example<Term>());
      const auto [sum, size] = bench.total([&](std::size_t i) {
        return bench.template get<m>()[i] / bench.template get<rho>()[i] * bench.template get<drho_diff>()[i];
      });
      EXPECT_LE(std::abs(sum), 1e-13 * size) << Term::info.name << ' ' << N;
    });
  });
}

/// Largest magnitude of the diffusion rate, over all particles or the bulk.
template <int N, class Term>
double largest_rate(Bench<N>& bench, const Term& term, bool bulk) {
  bench.run(term);
  double largest = 0;
  const auto look = [&](std::size_t i) { largest = std::max(largest, std::abs(bench.template get<drho_diff>()[i])); };
  if (bulk) {
    bench.for_bulk(look);
  } else {
    for (std::size_t i = 0; i < bench.size(); ++i) look(i);
  }
  return largest;
}

// Criterion: at most 1 % of molteni's rate on a column of Tait's liquid at rest, its surface and bottom included.
TEST(Terms, FourtakasLeavesAColumnAtRestAlone) {
  Bench<2> bench(fluid_crowd<2>());
  const double g = 9.81, c_0 = 20, gamma = 7, top = 0.16;
  for (std::size_t i = 0; i < bench.size(); ++i) {
    // c_0^2/(gamma - 1) ((rho/rho_0)^(gamma-1) - 1) = g (depth), from dp = -rho g dy.
    const double ratio = std::pow(1 + (gamma - 1) * g * (top - bench.get<x>()[i][1]) / sq(c_0), 1 / (gamma - 1));
    bench.get<rho>()[i] = 1000 * ratio;
    bench.get<c>()[i] = c_0 * std::pow(ratio, 0.5 * (gamma - 1));
  }
  const double whole = largest_rate(bench, terms::DiffusionMolteni{}, false);
  const double rest = largest_rate(bench, example<terms::DiffusionFourtakas>(), false);
  EXPECT_LE(rest, 0.01 * whole);
  std::printf("    fourtakas %.2g of molteni\n", rest / whole);
}

// Criterion: at most 1e-10 of molteni's rate for a linear density among disordered particles.
TEST(Terms, AntuonoLeavesLinearDensitiesAlone) {
  in_each_dimension([]<int N>() {
    Bench<N> bench(fluid_crowd<N>(0.2));
    for (std::size_t i = 0; i < bench.size(); ++i) {
      double density = 1000;
      for (int k = 0; k < N; ++k) density += (100 - 30 * k) * bench.template get<x>()[i][k];
      bench.template get<rho>()[i] = density;
    }
    bench.template run<terms::DensityGradient>();
    update(bench.store(), Group::fluid, rules::RenormaliseGradient<N>{});
    bench.for_bulk([&](std::size_t i) {
      for (int k = 0; k < N; ++k) EXPECT_NEAR(bench.template get<grad_rho_l>()[i][k], 100 - 30 * k, 1e-9) << N;
    });
    const double rest = [&] {
      bench.run(terms::DiffusionAntuono{});
      double largest = 0;
      bench.for_bulk([&](std::size_t i) { largest = std::max(largest, std::abs(bench.template get<drho_diff>()[i])); });
      return largest;
    }();
    EXPECT_LE(rest, 1e-10 * largest_rate(bench, terms::DiffusionMolteni{}, false)) << N;
  });
}

// ---- Viscosity and gradients
// -----------------------------------------------------------------------------------------

// Criterion: acc = mu/rho lap v for v_x = 1/2 |x|^2 on a lattice with h = 2 dx, in the bulk, within 3 %. With
// `wendland_c4`: `mueller` takes second derivatives, and those of the 1-D `wendland_c2` end in a kink that puts it 15 %
// off.
TEST(Terms, LaminarViscositiesApproachTheLaplacian) {
  in_each_dimension([]<int N>() {
    Bench<N> bench(fluid_crowd<N>(0, 4), KernelChoice::of<WendlandC4>());
    const double viscosity = 0.7, density = 900;
    for (std::size_t i = 0; i < bench.size(); ++i) {
      bench.template get<v>()[i] = Vec<N>{{0.5 * norm_sq(bench.template get<x>()[i])}};
      bench.template get<rho>()[i] = density;
      bench.template get<m>()[i] = density * std::pow(0.01, N);
      bench.template get<mu>()[i] = viscosity;
    }
    terms::ViscosityForms::for_each([&]<class Term>(Term) {
      bench.template run<Term>();
      double worst = 0;
      bench.for_bulk([&](std::size_t i) {
        worst = std::max(worst, std::abs(bench.template get<acc>()[i][0] / (viscosity / density * N) - 1));
      });
      EXPECT_LE(worst, 0.03) << Term::info.name << ' ' << N;
      std::printf("    %s in %d-D: %.2g off\n", Term::info.name.data(), N, worst);
    });
  });
}

// Criterion: the velocity gradient of v_i = sum_j A_ij x_j is A_ij at [j][i], within 3 % of the largest in the bulk of
// a lattice.
TEST(Terms, VelocityGradientIsTheGradient) {
  Bench<3> bench(fluid_crowd<3>(0));
  const auto slope = [](int i, int j) { return 1.0 + 2 * i - j; };
  for (std::size_t k = 0; k < bench.size(); ++k) {
    bench.get<rho>()[k] = 1000;
    bench.get<m>()[k] = 1e-3;
    for (int i = 0; i < 3; ++i) {
      bench.get<v>()[k][i] = 0;
      for (int j = 0; j < 3; ++j) bench.get<v>()[k][i] += slope(i, j) * bench.get<x>()[k][j];
    }
  }
  bench.run<terms::VelocityGradient>();
  bench.for_bulk([&](std::size_t k) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(bench.get<strain>()[k][j][i], slope(i, j), 0.15);
  });
}

}  // namespace
}  // namespace undine
