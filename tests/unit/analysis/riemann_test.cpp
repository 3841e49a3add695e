#include "undine/analysis/exact/riemann.hpp"

#include <filesystem>

#include <gtest/gtest.h>

#include "undine/core/error.hpp"
#include "undine/io/time_series.hpp"
#include "unit/analysis/identities.hpp"

namespace undine::exact {
namespace {

using test::table;

Riemann problem(const GasState& l, const GasState& r, double gamma = 1.4) {
  Riemann s;
  s.rho_left = l.rho, s.v_left = l.v, s.p_left = l.p;
  s.rho_right = r.rho, s.v_right = r.v, s.p_right = r.p;
  s.gamma = gamma;
  return s;
}

struct Named {
  const char* name;
  Riemann problem;
};

/// Fans, shocks, cold gas, equal sides, vacua made, on the left and on the right; several gammas.
std::vector<Named> problems() {
  return {{"sod", problem({1, 0, 1}, {0.125, 0, 0.1})},
          {"mirrored", problem({0.125, 0, 0.1}, {1, 0, 1})},
          {"two fans", problem({1, -2, 0.4}, {1, 2, 0.4})},
          {"blast", problem({1, 0, 1000}, {1, 0, 0.01})},
          {"two shocks", problem({5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.095})},
          {"moving, gamma 5/3", problem({2, 3, 1.5}, {0.7, 2.5, 4}, 5.0 / 3)},
          {"nearly isothermal", problem({1, 0.1, 1}, {0.3, -0.2, 0.2}, 1.01)},
          {"stiff", problem({1, 0.1, 1}, {0.3, -0.2, 0.2}, 6)},
          {"nothing happens", problem({1, 0.5, 2}, {1, 0.5, 2})},
          {"cold gases collide", problem({1, 1, 0}, {3, -1, 0})},
          {"cold gas is hit", problem({1, 0, 1}, {0.2, 0, 0})},
          {"torn apart", problem({1, -6, 0.4}, {0.6, 7, 0.2})},
          {"into a vacuum", problem({1, 0.3, 1}, {0, 0, 0})},
          {"out of a vacuum", problem({0, 0, 0}, {0.5, 0.3, 1}, 5.0 / 3)}};
}

// Toro (2009), table 4.3; the printed digits.
TEST(Riemann, MeetsTorosFiveTests) {
  struct Case {
    GasState left, right;
    double p, v, rho_left, rho_right;
  };
  for (const auto& c :
       {Case{{1, 0, 1}, {0.125, 0, 0.1}, 0.30313, 0.92745, 0.42632, 0.26557},
        Case{{1, -2, 0.4}, {1, 2, 0.4}, 0.00189, 0, 0.02185, 0.02185},
        Case{{1, 0, 1000}, {1, 0, 0.01}, 460.894, 19.5975, 0.57506, 5.99924},
        Case{{1, 0, 0.01}, {1, 0, 100}, 46.0950, -6.19633, 5.99242, 0.57511},
        Case{{5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, 1691.64, 8.68975, 14.2823, 31.0426}}) {
    const RiemannFan fan = problem(c.left, c.right).fan();
    const auto digits = [](double value) { return std::max(5e-6, 6e-6 * std::abs(value)); };
    EXPECT_NEAR(fan.p(), c.p, digits(c.p));
    EXPECT_NEAR(fan.v(), c.v, digits(c.v));
    const double beside = 1e-9 * (1 + std::abs(fan.v()));
    EXPECT_NEAR(fan(fan.v() - beside).rho, c.rho_left, 2 * digits(c.rho_left));
    EXPECT_NEAR(fan(fan.v() + beside).rho, c.rho_right, 2 * digits(c.rho_right));
  }
}

TEST(Riemann, MeetsTheTables) {
  const auto compare = [](const char* file, const Riemann& s) {
    SCOPED_TRACE(file);
    const CsvTable data = table(file);
    const auto f = s.at(0.2);
    for (std::size_t i = 0; i < data.rows; ++i) {
      const Values<4> v = f({{data.column("x").values[i]}});
      EXPECT_NEAR(v[0], data.column("rho").values[i], 5e-8);  // x is rounded to 5e-9
      EXPECT_NEAR(v[1], data.column("v").values[i], 5e-8);
      EXPECT_NEAR(v[2], data.column("p").values[i], 5e-8);
      EXPECT_NEAR(v[3], data.column("e").values[i], 5e-8);
    }
    EXPECT_GE(data.rows, 1000U);
  };
  compare("riemann_sod_t0.2.csv", {});
  compare("riemann_hernquist_katz_liu_t0.2.csv", problem({1, 0, 1}, {0.25, 0, 0.1795}));
}

/// Where fan(s) is discontinuous between two rays, to rounding, from a coarse walk and bisection.
std::vector<double> jumps(const RiemannFan& fan, double from, double to) {
  std::vector<double> found;
  const auto differ = [&](double a, double b) {
    const GasState l = fan(a), r = fan(b);
    constexpr double scale = 1e-6, nearly_empty = 1e-3;  // at the edge of a vacuum all is continuous
    return std::abs(l.rho - r.rho) > scale * (l.rho + r.rho + nearly_empty) ||
           std::abs(l.p - r.p) > scale * (l.p + r.p + nearly_empty);
  };
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k) {
    double a = from + (to - from) * k / n, b = from + (to - from) * (k + 1) / n;
    for (int i = 0; i < 60 && differ(a, b); ++i) (differ(a, 0.5 * (a + b)) ? b : a) = 0.5 * (a + b);
    if (differ(a, b)) found.push_back(b);
  }
  return found;
}

// Across each jump, in its frame: mass, momentum and energy fluxes are equal to 1e-9 of their parts; gas that passes a
// shock gains entropy.
TEST(Riemann, JumpsObeyRankineAndHugoniot) {
  int shocks = 0;
  for (const auto& [name, s] : problems()) {
    SCOPED_TRACE(name);
    const RiemannFan fan = s.fan();
    for (const double speed : jumps(fan, -40, 40)) {
      const double beside = 1e-9 * (1 + std::abs(speed));
      const GasState a = fan(speed - beside), b = fan(speed + beside);
      const double ua = a.v - speed, ub = b.v - speed;
      const double flux = std::abs(a.rho * ua) + std::abs(b.rho * ub);
      EXPECT_NEAR(a.rho * ua, b.rho * ub, 1e-7 * (flux + a.rho + b.rho)) << speed;
      EXPECT_NEAR(a.rho * ua * ua + a.p, b.rho * ub * ub + b.p, 1e-7 * (a.p + b.p + flux)) << speed;
      const auto enthalpy = [gamma = s.gamma](const GasState& k, double u) {
        return 0.5 * u * u + gamma / (gamma - 1) * k.p / k.rho;
      };
      if (std::abs(ua) < 1e-6 * (1 + std::abs(speed))) continue;  // the contact: nothing flows through
      ++shocks;
      EXPECT_NEAR(enthalpy(a, ua), enthalpy(b, ub), 1e-7 * (enthalpy(a, ua) + enthalpy(b, ub))) << speed;
      const double entropy_a = a.p / std::pow(a.rho, s.gamma), entropy_b = b.p / std::pow(b.rho, s.gamma);
      EXPECT_GT(ua > 0 ? entropy_b - entropy_a : entropy_a - entropy_b, 0) << speed;
    }
  }
  EXPECT_GE(shocks, 10);
}

// Where the solution is smooth, density, velocity and pressure obey the Euler equations; entropy is that of its side.
TEST(Riemann, SmoothPartsSolveTheEulerEquations) {
  int inside = 0;
  for (const auto& [name, s] : problems()) {
    SCOPED_TRACE(name);
    const RiemannFan fan = s.fan();
    for (double ray = -12; ray < 12; ray += 0.0371) {
      constexpr double d = 1e-4;
      const GasState here = fan(ray), before = fan(ray - d), after = fan(ray + d);
      const auto slope = [&](auto member) { return (after.*member - before.*member) / (2 * d); };
      const auto bend = [&](auto member) { return after.*member - 2 * here.*member + before.*member; };
      const double rise = std::abs(slope(&GasState::rho));
      // Only inside a fan: neither even nor beside a corner or a jump.
      if (here.rho < 1e-2 || rise < 1e-4 || std::abs(bend(&GasState::rho)) > 1e-3 * d * rise) continue;
      ++inside;
      // f(x/t): f_t = -s f', f_x = f', times t.
      const double u = here.v - ray;
      EXPECT_NEAR(u * slope(&GasState::rho) + here.rho * slope(&GasState::v), 0, 1e-5 * rise);
      EXPECT_NEAR(here.rho * u * slope(&GasState::v) + slope(&GasState::p), 0, 1e-5 * std::abs(slope(&GasState::p)));
      const GasState& side =
          slope(&GasState::p) < 0 ? GasState{s.rho_left, 0, s.p_left} : GasState{s.rho_right, 0, s.p_right};
      EXPECT_NEAR(here.p / std::pow(here.rho, s.gamma), side.p / std::pow(side.rho, s.gamma),
                  1e-10 * side.p / std::pow(side.rho, s.gamma));
    }
  }
  EXPECT_GE(inside, 200);
}

// Mass, momentum and energy of [-X, X] change by what flows through the ends: to 2e-5 by the midpoint rule on 400,000
// cells (each jump costs half a cell).
TEST(Riemann, ConservesMassMomentumAndEnergy) {
  for (const auto& [name, s] : problems()) {
    SCOPED_TRACE(name);
    constexpr double X = 40, t = 1;
    constexpr int n = 400000;
    const auto f = s.at(t);
    double mass = 0, momentum = 0, energy = 0;
    for (int k = 0; k < n; ++k) {
      const auto [rho, v, p, e] = f({{X * (2 * (k + 0.5) / n - 1)}});
      const double dx = 2 * X / n;
      mass += rho * dx;
      momentum += rho * v * dx;
      energy += rho * (0.5 * v * v + e) * dx;
    }
    const auto density = [gamma = s.gamma](double rho, double v, double p) {
      return 0.5 * rho * v * v + p / (gamma - 1);
    };
    const double eL = density(s.rho_left, s.v_left, s.p_left), eR = density(s.rho_right, s.v_right, s.p_right);
    const double jL = s.rho_left * s.v_left, jR = s.rho_right * s.v_right;
    const double cells = 2 * X / n * 5;
    EXPECT_NEAR(mass, (s.rho_left + s.rho_right) * X + (jL - jR) * t, cells * 40);
    EXPECT_NEAR(momentum, (jL + jR) * X + (jL * s.v_left + s.p_left - jR * s.v_right - s.p_right) * t,
                cells * 40 * (10 + std::abs(jL)));
    EXPECT_NEAR(energy, (eL + eR) * X + ((eL + s.p_left) * s.v_left - (eR + s.p_right) * s.v_right) * t,
                1e-4 * (eL + eR) * X + cells);
  }
}

TEST(Riemann, OpensAVacuumExactlyBeyondTheEscapeSpeed) {
  const double escape = 2 * 2 / 0.4 * std::sqrt(1.4 * 0.4);
  EXPECT_FALSE(problem({1, -0.4999 * escape, 0.4}, {1, 0.4999 * escape, 0.4}).fan().vacuum());
  const RiemannFan fan = problem({1, -0.51 * escape, 0.4}, {1, 0.51 * escape, 0.4}).fan();
  EXPECT_TRUE(fan.vacuum());
  const double edge = 0.01 * escape;
  EXPECT_EQ(fan(0.99 * edge).rho, 0);
  EXPECT_GT(fan(1.01 * edge).rho, 0);
  EXPECT_EQ(fan(-0.99 * edge).rho, 0);
  EXPECT_NEAR(fan(1.0001 * edge).v, edge, 1e-3 * edge);
  // A front into a vacuum runs at v + 2 c/(gamma-1).
  const RiemannFan front = problem({1, 0.3, 1}, {0, 0, 0}).fan();
  const double speed = 0.3 + 5 * std::sqrt(1.4);
  EXPECT_GT(front(0.9999 * speed).rho, 0);
  EXPECT_EQ(front(1.0001 * speed).rho, 0);
}

TEST(Riemann, RefusesWhatIsNoGas) {
  EXPECT_THROW(problem({0, 0, 1}, {1, 0, 1}).at(1), InputError);
  EXPECT_THROW(problem({1, 0, 1}, {1, 0, 1}, 1).at(1), InputError);
}

TEST(Riemann, BeginsAsTheTwoSides) {
  Riemann s;
  s.diaphragm = 3;
  const auto f = s.at(0);
  EXPECT_EQ(f({{2.999}})[0], 1);
  EXPECT_EQ(f({{3.001}})[0], 0.125);
}

}  // namespace
}  // namespace undine::exact
