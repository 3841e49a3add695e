#include <gtest/gtest.h>

#include "undine/analysis/exact/noh.hpp"
#include "undine/analysis/exact/sedov.hpp"
#include "undine/core/error.hpp"
#include "unit/analysis/identities.hpp"

namespace undine::exact {
namespace {

using test::slope;
using test::table;

double sphere_surface(double d) { return d == 1 ? 2 : d == 2 ? 2 * pi : 4 * pi; }

constexpr double gammas[] = {1.1, 1.4, 5.0 / 3, 2, 3, 6.9, 7};

template <class F>
void for_all_blasts(F f) {
  for (const double d : {1.0, 2.0, 3.0})
    for (const double gamma : gammas) {
      SCOPED_TRACE("d = " + std::to_string(d) + ", gamma = " + std::to_string(gamma));
      f(Sedov{.dimensions = d, .gamma = gamma, .E = 2, .rho_0 = 3});
    }
}

// Kamm and Timmes (2007) and Sedov (1959): 0.851072 and 0.984074 for gamma = 1.4; in 3-D, gamma 5/3, R = 1.15167 (E
// t^2/ rho_0)^(1/5).
TEST(Sedov, MeetsThePublishedConstants) {
  EXPECT_NEAR(SedovProfile(3, 1.4).alpha(), 0.851072, 5e-7);
  EXPECT_NEAR(SedovProfile(2, 1.4).alpha(), 0.984074, 5e-7);
  EXPECT_NEAR(std::pow(SedovProfile(3, 5.0 / 3).alpha(), -0.2), 1.1516664179, 1e-9);
  EXPECT_NEAR(std::pow(SedovProfile(2, 5.0 / 3).alpha(), -0.25), 1.1537870875, 1e-9);
  EXPECT_NEAR(SedovProfile(3, 5.0 / 3).kinetic_share(), 0.28275549, 1e-8);
}

// gamma = 7 in 3-D: V = 1/4, rho ~ r, p ~ r^3 (Primakoff), so alpha = 4 pi/25 int (...) = 2 pi/225.
TEST(Sedov, IsPrimakoffsSolutionForGammaSeven) {
  const SedovProfile shape(3, 7);
  for (const double lambda : {0.01, 0.3, 0.77, 1.0}) {
    EXPECT_NEAR(shape(lambda).V, 0.25, 1e-12);
    EXPECT_NEAR(shape(lambda).rho, 4.0 / 3 * lambda, 1e-10);
    EXPECT_NEAR(shape(lambda).p, 0.25 * cube(lambda), 1e-10);
  }
  EXPECT_NEAR(shape.alpha(), 2 * pi / 225, 1e-9);
}

TEST(Sedov, MeetsTheTables) {
  const auto compare = [](const char* file, double d) {
    SCOPED_TRACE(file);
    const CsvTable data = table(file);
    const auto f = Sedov{.dimensions = d}.at(0.05);
    for (std::size_t i = 0; i < data.rows; ++i) {
      const double r = data.column("r").values[i];
      const Values<4> v = f({{r}});
      const auto near = [&](double value, const char* column, double limit) {
        const double wanted = data.column(column).values[i];
        EXPECT_NEAR(value, wanted, limit * std::abs(wanted)) << column << " at " << r;
      };
      // r has eight decimals; rho ~ r^4.5 and e ~ r^-4.5 turn them into this at the centre.
      const double limit = 1e-7 + 5 * 1e-8 / r;
      near(v[0], "rho", limit);
      near(v[1], "v", limit);
      near(v[2], "p", limit);
      near(v[3], "e", limit);
    }
    EXPECT_GE(data.rows, 1000U);
  };
  compare("sedov_2d_t0.05.csv", 2);
  compare("sedov_3d_t0.05.csv", 3);
}

TEST(Sedov, ShockIsStrong) {
  for_all_blasts([](const Sedov& s) {
    const double t = 0.7, R = s.shock_radius(t, s.profile().alpha());
    const double S = 2 / (s.dimensions + 2) * R / t;
    EXPECT_NEAR(slope([&](double at) { return s.shock_radius(at, s.profile().alpha()); }, t, 1e-3), S, 1e-9 * S);
    const auto [rho, v, p, e] = s.at(t)({{R * (1 - 1e-13)}});
    // Rankine-Hugoniot with p_0 = 0.
    EXPECT_NEAR(rho * (S - v), s.rho_0 * S, 1e-9 * s.rho_0 * S);
    EXPECT_NEAR(p, s.rho_0 * S * v, 1e-9 * p);
    EXPECT_NEAR(e, 0.5 * v * v, 1e-9 * e);
    const auto ahead = s.at(t)({{R * 1.0001}});
    EXPECT_EQ(ahead, (Values<4>{s.rho_0, 0, 0, 0}));
  });
}

// Continuity, momentum and entropy by differences, in r and t, to 1e-6 of their largest term.
TEST(Sedov, SolvesTheEulerEquations) {
  for_all_blasts([](const Sedov& s) {
    const double t = 0.7, R = s.shock_radius(t, s.profile().alpha());
    for (const double lambda : {0.6, 0.95}) {
      const double r = lambda * R, dr = 2e-4 * R, dt = 2e-4 * t;
      const auto in_r = [&](int field) {
        const auto f = s.at(t);
        return slope([&](double at) { return f({{at}})[static_cast<std::size_t>(field)]; }, r, dr);
      };
      const auto in_t = [&](int field) {
        return slope([&](double at) { return s.at(at)({{r}})[static_cast<std::size_t>(field)]; }, t, dt);
      };
      const auto [rho, v, p, e] = s.at(t)({{r}});
      const double divergence = in_r(1) + (s.dimensions - 1) * v / r;
      EXPECT_NEAR(in_t(0) + v * in_r(0) + rho * divergence, 0, 1e-6 * std::abs(rho * divergence)) << lambda;
      const double rounding = 1e-16 * p / dr;  // of the pressure gradient, which is nothing to p where rho is
      EXPECT_NEAR(rho * (in_t(1) + v * in_r(1)) + in_r(2), 0, 1e-6 * rho * (std::abs(in_t(1)) + v / t) + 100 * rounding)
          << lambda;
      EXPECT_NEAR(in_t(3) + v * in_r(3) + p / rho * divergence, 0, 1e-6 * std::abs(in_t(3))) << lambda;
    }
  });
}

// The shells sum to the energy E and to the swept mass: midpoint rule, uniform in lambda^(d/4), 1e-5.
TEST(Sedov, HoldsItsEnergyAndItsMass) {
  for_all_blasts([](const Sedov& s) {
    const double t = 0.7, R = s.shock_radius(t, s.profile().alpha()), d = s.dimensions;
    const auto f = s.at(t);
    double mass = 0, energy = 0;
    constexpr int n = 20000;
    for (int k = 0; k < n; ++k) {
      // Close to gamma = 1 all mass is in a thin shell: cells shrink towards the shock.
      const auto edge = [&](int i) { return R * (1 - sq(1 - i / double{n})); };
      const double a = edge(k), b = edge(k + 1), r = 0.5 * (a + b);
      const double volume = sphere_surface(d) / d * (std::pow(b, d) - std::pow(a, d));
      const auto [rho, v, p, e] = f({{r}});
      mass += rho * volume;
      energy += (0.5 * rho * v * v + p / (s.gamma - 1)) * volume;
    }
    EXPECT_NEAR(mass, s.rho_0 * sphere_surface(d) / d * std::pow(R, d), 1e-5 * mass);
    EXPECT_NEAR(energy, s.E, 1e-5 * s.E);
  });
}

TEST(Sedov, RefusesWhatItHasNot) {
  EXPECT_THROW((Sedov{.gamma = 1}.at(1)), InputError);
  EXPECT_THROW((Sedov{.dimensions = 3, .gamma = 7.1}.at(1)), InputError);
  EXPECT_THROW((Sedov{.dimensions = 1.5}.at(1)), InputError);
  EXPECT_THROW((Sedov{.dimensions = 4}.at(1)), InputError);
}

TEST(Sedov, IsFiniteAtTheCentreAndAtTheStart) {
  for_all_blasts([](const Sedov& s) {
    const auto [rho, v, p, e] = s.at(1)({{0.0}});
    EXPECT_GE(rho, 0);
    EXPECT_EQ(v, 0);
    EXPECT_TRUE(std::isfinite(p));
    EXPECT_GT(p, s.dimensions == 3 && s.gamma == 7 ? -1e-300 : 1e-4 * s.E);
    EXPECT_EQ(s.at(0)({{0.1}})[0], s.rho_0);
  });
}

TEST(Noh, MeetsTheTables) {
  for (const double d : {1.0, 2.0, 3.0}) {
    const CsvTable data = table("noh_" + std::to_string(static_cast<int>(d)) + "d_t0.6.csv");
    const auto f = Noh{.dimensions = d}.at(0.6);
    for (std::size_t i = 0; i < data.rows; ++i) {
      const Values<4> v = f({{data.column("r").values[i]}});
      EXPECT_NEAR(v[0], data.column("rho").values[i], 1e-8 * v[0]);
      EXPECT_EQ(v[1], data.column("v").values[i]);
      EXPECT_NEAR(v[2], data.column("p").values[i], 1e-8 * 22);
      EXPECT_NEAR(v[3], data.column("e").values[i], 1e-9);
    }
    EXPECT_EQ(data.rows, 1000U);
  }
}

// Jump conditions at the shock, in its frame, and the mass inside r = 2: what was within 2 + v_0 t.
TEST(Noh, ObeysRankineAndHugoniotAndKeepsItsMass) {
  for (const double d : {1.0, 2.0, 3.0})
    for (const double gamma : {1.2, 1.4, 5.0 / 3, 3.0}) {
      const Noh s{.dimensions = d, .gamma = gamma, .rho_0 = 2, .v_0 = 1.5};
      const double t = 0.4, S = (gamma - 1) / 2 * s.v_0, R = S * t;
      const auto f = s.at(t);
      const auto [rho1, v1, p1, e1] = f({{R * (1 - 1e-12)}});
      const auto [rho0, v0, p0, e0] = f({{R * (1 + 1e-12)}});
      EXPECT_NEAR(rho1 * (v1 - S), rho0 * (v0 - S), 1e-10 * rho1 * S);
      EXPECT_NEAR(p1 + rho1 * sq(v1 - S), p0 + rho0 * sq(v0 - S), 1e-10 * p1);
      EXPECT_NEAR(e1 + p1 / rho1 + sq(v1 - S) / 2, e0 + sq(v0 - S) / 2, 1e-10 * e1);
      double mass = 0;
      constexpr int n = 4000;
      for (const auto& [a, b] : {std::pair(0.0, R), {R, 2.0}})
        for (int k = 0; k < n; ++k) {
          const double r = a + (b - a) * (k + 0.5) / n;
          mass += f({{r}})[0] * sphere_surface(d) * std::pow(r, d - 1) * (b - a) / n;
        }
      EXPECT_NEAR(mass, s.rho_0 * sphere_surface(d) / d * std::pow(2 + s.v_0 * t, d), 1e-6 * mass);
    }
}

}  // namespace
}  // namespace undine::exact
