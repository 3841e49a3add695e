#include <algorithm>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <omp.h>

#include "unit/engine/crowd.hpp"
#include "unit/engine/every_term.hpp"
#include "unit/under_sanitizer.hpp"

// Every term of every list of terms/catalogue.hpp, on disordered fluid and wall particles: each backend against plain
// serial loops over all pairs. A new term is tested by being in its list.

namespace undine {
namespace {

using test::Crowd;
using test::EveryTerm;
using test::make_crowd;

const Backend serial{BackendKind::serial, PairPrecision::double_precision};
const Backend threads_double{BackendKind::threads, PairPrecision::double_precision};
const Backend threads_mixed{BackendKind::threads, PairPrecision::mixed};
const Backend checked{BackendKind::checked, PairPrecision::double_precision};

template <int N>
constexpr int side = N == 1   ? 80
                     : N == 2 ? 16
                              : (test::under_sanitizer ? 7 : 9);

/// How a sweep is to be run.
struct Manner {
  Support support{};  ///< `uniform` is set by the crowd
  std::array<int, kernel_roles> kernels{};
};

template <int N>
struct Bench {
  Crowd<N> crowd;
  Neighbours<N> neighbours;
  Manner manner;
  std::vector<std::pair<int, std::vector<double>>> before;  ///< fields that the last sweep wrote

  Bench(const Crowd<N>& made, const Manner& how, const std::string& search, bool store_lists)
      : crowd(made),
        neighbours(made.domain, {.search = search, .skin = 0.1, .lists = store_lists ? Lists::stored : Lists::plain}),
        manner(how) {
    manner.support.uniform = crowd.support;
    neighbours.build(crowd.store, crowd.support);
  }
  SweepContext<N> context() {
    std::array<KernelChoice, kernel_roles> kernels;
    for (int role = 0; role < kernel_roles; ++role) kernels[role] = KernelChoice(manner.kernels[role]);
    return {crowd.store, neighbours, crowd.domain, manner.support, kernels, 1000};
  }
  /// What the terms in use add to the particles of a group.
  std::vector<std::vector<double>> results(EveryTerm<N>& sweep, const FieldSet& adds, const Backend& backend) {
    // What one term adds another may read: it is as it was before the last sweep.
    for (const auto& [f, numbers] : before) std::ranges::copy(numbers, crowd.store.raw(f).begin());
    before.clear();
    for (int f = 0; f < FieldId::count; ++f) {
      if (!adds[f]) continue;
      const auto raw = crowd.store.raw(f);
      before.emplace_back(f, std::vector<double>(raw.begin(), raw.end()));
      std::ranges::fill(raw, 1e99);
    }
    sweep.run(context(), backend);
    const IndexRange r = crowd.store.range(sweep.target());
    std::vector<std::vector<double>> values;
    for (int f = 0; f < FieldId::count; ++f) {
      if (!adds[f]) continue;
      const auto n = static_cast<std::size_t>(all_fields[f].components(N));
      const auto raw = crowd.store.raw(f).subspan(r.begin * n, r.size() * n);
      values.emplace_back(raw.begin(), raw.end());
    }
    return values;
  }
};

/// Largest difference of any field, relative to the largest magnitude of that field.
double error(const std::vector<std::vector<double>>& values, const std::vector<std::vector<double>>& expected) {
  double worst = 0;
  for (std::size_t f = 0; f < expected.size(); ++f) {
    double largest = 0, difference = 0;
    for (std::size_t k = 0; k < expected[f].size(); ++k) {
      largest = std::max(largest, std::abs(expected[f][k]));
      difference = std::max(difference, std::abs(values[f][k] - expected[f][k]));
      if (std::isnan(values[f][k])) return std::numeric_limits<double>::infinity();
    }
    EXPECT_GT(largest, 0);
    worst = std::max(worst, difference / largest);
  }
  return worst;
}

/// The largest error seen, and where.
struct Worst {
  double value = 0;
  std::string where;
  void note(double seen, const std::string& place) {
    if (seen > value) *this = {seen, place};
  }
};

struct Errors {
  Worst in_double, in_mixed;
  void print() const {
    std::printf("    largest relative error: double %.2g (%s), mixed %.2g (%s)\n", in_double.value,
                in_double.where.c_str(), in_mixed.value, in_mixed.where.c_str());
  }
};

/// Criterion: relative error of threads against serial brute force <= 1e-12 in double and <= 1e-5 mixed, for each term
/// and target group, with each instruction set that this machine has.
template <int N>
void compare(const Crowd<N>& crowd, const Manner& manner, const std::string& place, Errors& errors) {
  SCOPED_TRACE(place);
  Bench<N> plain(crowd, manner, "all_pairs", false), fast(crowd, manner, "cell_grid", true);
  for (const Group target : all_groups) {
    EveryTerm<N> sweep("test", target);
    test::for_each_term([&]<class Term>(Term term) {
      const bool fluid = target == Group::fluid;
      if constexpr (requires { term.gravity; }) term.gravity = {{1, -9.81, 2}};
      test::use_only<Term>(sweep, term, {true, fluid});  // walls do not act on walls
      const auto expected = plain.results(sweep, Term::adds::set(), serial);
      for (const auto set : {InstructionSet::basic, InstructionSet::avx2, InstructionSet::avx512}) {
        if (!can_run(set)) continue;
        const auto error_in = [&](PairPrecision precision) {
          return error(fast.results(sweep, Term::adds::set(), {BackendKind::threads, precision, set}), expected);
        };
        const double in_double = error_in(PairPrecision::double_precision), in_mixed = error_in(PairPrecision::mixed);
        const std::string where = std::string(Term::info.name) + ", " + place + ", " +
                                  std::string(instruction_set_names[static_cast<std::size_t>(set)]);
        EXPECT_LE(in_double, 1e-12) << where;
        EXPECT_LE(in_mixed, 1e-5) << where;
        errors.in_double.note(in_double, where);
        errors.in_mixed.note(in_mixed, where);
      }
    });
  }
}

template <class F>
void in_each_dimension(F f) {
  f.template operator()<1>();
  f.template operator()<2>();
  f.template operator()<3>();
}

const std::array<int, kernel_roles> wendland{Kernels::index<WendlandC2>(), Kernels::index<WendlandC2>(),
                                             Kernels::index<WendlandC2>()};

std::string text(int n, bool periodic) { return std::to_string(n) + (periodic ? "-D periodic" : "-D open"); }

TEST(Sweep, ThreadsAgreeWithBruteForce) {
  Errors errors;
  in_each_dimension([&]<int N>() {
    for (const bool periodic : {false, true})
      compare(make_crowd<N>({.side = side<N>, .periodic = periodic}), {.kernels = wendland}, text(N, periodic), errors);
  });
  errors.print();
}

// Every kernel in every role.
TEST(Sweep, ThreadsAgreeWithBruteForceForEveryKernel) {
  Errors errors;
  const auto crowd = make_crowd<2>({.side = 11, .wall_layers = 2});
  for (int k = 0; k < Kernels::size; ++k)
    compare(crowd, {.kernels = {k, (k + 1) % Kernels::size, (k + 5) % Kernels::size}},
            std::string(Kernels::info(k).name), errors);
  errors.print();
}

TEST(Sweep, ThreadsAgreeWithBruteForceWithASupportPerParticle) {
  Errors errors;
  in_each_dimension([&]<int N>() {
    const bool periodic = N == 2;
    const auto crowd = make_crowd<N>({.side = N == 2 ? 12 : side<N>, .periodic = periodic});
    for (const auto mean :
         {Symmetrisation::arithmetic, Symmetrisation::geometric, Symmetrisation::max, Symmetrisation::min})
      compare(crowd, {.support = {.kappa = 2, .per_particle = true, .mean = mean}, .kernels = wendland},
              text(N, periodic) + ", mean " + std::to_string(static_cast<int>(mean)), errors);
  });
  errors.print();
}

TEST(Sweep, ThreadsAgreeWithBruteForceFarFromTheOrigin) {
  Errors errors;
  in_each_dimension([&]<int N>() {
    for (const bool periodic : {false, true})
      compare(make_crowd<N>(
                  {.side = N == 3 ? (test::under_sanitizer ? 7 : 8) : side<N>, .origin = 1e4, .periodic = periodic}),
              {.kernels = wendland}, text(N, periodic), errors);
  });
  errors.print();
}

// Criterion: the same bits, sums, maxima and booked powers, for 1, 2 and 4 threads.
TEST(Sweep, GivesTheSameBitsForAnyNumberOfThreads) {
  const int threads = omp_get_max_threads();
  for (const Backend& backend : {threads_double, threads_mixed}) {
    Bench<2> bench(make_crowd<2>({.side = 30}), {.kernels = wendland}, "cell_grid", true);
    EveryTerm<2> sweep("test", Group::fluid, Booking::on);
    test::for_each_term([&]<class Term>(Term term) {
      test::use_only<Term>(sweep, term);
      std::vector<std::vector<double>> first;
      std::vector<Power> first_powers;
      for (const int n : {1, 2, 4}) {
        omp_set_num_threads(n);
        auto values = bench.results(sweep, Term::adds::set(), backend);
        std::vector<Power> powers;
        std::apply([&](const auto&... use) { (powers.push_back(use.power), ...); }, sweep.uses());
        if (n == 1) {
          first = std::move(values);
          first_powers = powers;
          continue;
        }
        EXPECT_EQ(values, first) << Term::info.name << " with " << n << " threads";
        EXPECT_EQ(powers, first_powers) << Term::info.name << " with " << n << " threads";
      }
    });
  }
  omp_set_num_threads(threads);
}

// Criterion: booked power = sum m v.acc (and m de; or m p/rho^2 drho) over the targets, to 1e-13; fluid and wall apart
// add up to both.
TEST(Sweep, BooksThePowerOfWhatItAdds) {
  Bench<2> bench(make_crowd<2>({.side = 14}), {.kernels = wendland}, "cell_grid", true);
  EveryTerm<2> sweep("test", Group::fluid, Booking::on);
  auto& store = bench.crowd.store;
  const auto booked = [&](Group source) {
    double power = 0;
    std::apply(
        [&](const auto&... use) { ((power += use.acts_on(source) ? use.power[static_cast<int>(source)] : 0), ...); },
        sweep.uses());
    return power;
  };
  test::for_each_term([&]<class Term>(Term term) {
    test::use_only<Term>(sweep, term);
    bench.results(sweep, Term::adds::set(), threads_double);
    double power = 0, size = 0;
    const IndexRange fluid = store.range(Group::fluid);
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) {
      const double m = store.get<field::m>()[i], p = store.get<field::p>()[i], rho = store.get<field::rho>()[i];
      double one = 0;
      if constexpr (Term::adds::template has<field::de>) one = m * store.get<field::de>()[i];
      if constexpr (Term::adds::template has<field::acc>)
        one += m * dot(store.get<field::v>()[i], store.get<field::acc>()[i]);
      if constexpr (Term::adds::template has<field::acc_wall>)
        one = m * dot(store.get<field::v>()[i], store.get<field::acc_wall>()[i]);
      if constexpr (Term::adds::template has<field::drho>) one = m * p / sq(rho) * store.get<field::drho>()[i];
      if constexpr (Term::adds::template has<field::drho_diff>)
        one = m * p / sq(rho) * store.get<field::drho_diff>()[i];
      power += one;
      size += std::abs(one);
    }
    EXPECT_NEAR(booked(Group::fluid) + booked(Group::wall), power, 1e-13 * size) << Term::info.name;
  });
}

// Criterion: exactly zero for groups that are not sources, and for terms that are not active.
TEST(Sweep, SumsOnlyFromTheGroupsItIsGiven) {
  Bench<2> bench(make_crowd<2>({.side = 14}), {.kernels = wendland}, "cell_grid", true);
  EveryTerm<2> sweep("test", Group::fluid);
  const auto density = [&](std::array<bool, group_count> sources) {
    test::use_only<terms::Summation>(sweep, {}, sources);
    return bench.results(sweep, terms::Summation::adds::set(), threads_double)[0];
  };
  const auto both = density({true, true}), fluid = density({true, false}), wall = density({false, true}),
             none = density({false, false});
  for (std::size_t k = 0; k < both.size(); ++k) {
    EXPECT_NEAR(fluid[k] + wall[k], both[k], 1e-12 * both[k]);
    EXPECT_EQ(none[k], 0);
  }
  // What no term in use adds to is left alone.
  test::use_only<terms::Summation>(sweep, {});
  EXPECT_EQ(sweep.adds(), terms::Summation::adds::set());
  const Vec<2> mark{{1, 2}};
  std::ranges::fill(bench.crowd.store.get<field::acc>(), mark);
  sweep.run(bench.context(), threads_double);
  for (const auto& acc : bench.crowd.store.get<field::acc>()) EXPECT_EQ(acc, mark);
}

// Criterion: the checked backend agrees with serial to the bit, and names the sweep, the field and the particle of a
// bad input.
TEST(Sweep, CheckedBackendNamesTheFieldThatNothingWrote) {
  Bench<2> bench(make_crowd<2>({.side = 10}), {.kernels = wendland}, "cell_grid", true);
  EveryTerm<2> sweep("pull", Group::fluid);
  test::use_only<terms::PressureSymmetric>(sweep, {});
  const auto adds = sweep.adds();
  const auto expected = bench.results(sweep, adds, serial);
  EXPECT_EQ(bench.results(sweep, adds, checked), expected);

  auto& store = bench.crowd.store;
  for (const Group group : all_groups)
    for (int f = 0; f < FieldId::count; ++f) {
      if (!sweep.reads()[f]) continue;
      const auto width = static_cast<std::size_t>(all_fields[f].components(2));
      const std::size_t particle = store.range(group).begin + 3;
      double& number = store.raw(f)[particle * width];
      const double kept = number;
      number = std::numeric_limits<double>::quiet_NaN();
      try {
        sweep.run(bench.context(), checked);
        ADD_FAILURE() << all_fields[f].name << " was not found";
      } catch (const RunError& error) {
        const std::string what = error.what();
        EXPECT_NE(what.find("'pull'"), std::string::npos) << what;
        EXPECT_NE(what.find("'" + std::string(all_fields[f].name) + "'"), std::string::npos) << what;
        EXPECT_NE(what.find("particle " + std::to_string(store.ids()[particle])), std::string::npos) << what;
      }
      number = kept;
    }
}

// A zero density is finite, but what the sweep makes of it is not.
TEST(Sweep, CheckedBackendNamesAResultThatIsNotFinite) {
  Bench<2> bench(make_crowd<2>({.side = 10}), {.kernels = wendland}, "cell_grid", true);
  EveryTerm<2> sweep("pull", Group::fluid);
  test::use_only<terms::PressureSymmetric>(sweep, {});
  bench.crowd.store.get<field::rho>()[5] = 0;
  try {
    sweep.run(bench.context(), checked);
    FAIL();
  } catch (const RunError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("'pull'"), std::string::npos) << what;
    EXPECT_NE(what.find("'acc'"), std::string::npos) << what;
    EXPECT_NE(what.find("not finite"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace undine
