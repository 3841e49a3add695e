#include <numeric>

#include <gtest/gtest.h>

#include "undine/analysis/exact/catalogue.hpp"
#include "undine/core/error.hpp"
#include "undine/materials/catalogue.hpp"
#include "unit/analysis/identities.hpp"

namespace undine::exact {
namespace {

using test::curvature;
using test::slope;
using test::table;

TEST(TaylorGreen, MeetsTheTable) {
  const CsvTable data = table("taylor_green_2d_decay.csv");
  for (std::size_t i = 0; i < data.rows; ++i) {
    const auto at = [&](const char* name) { return data.column(name).values[i]; };
    const auto f = TaylorGreen{.mu = 1 / at("Re")}.at(at("t"));
    EXPECT_NEAR(std::abs(f({{0, 0.25}})[0]), at("max_speed"), 1e-9 * at("max_speed"));
    EXPECT_NEAR(std::abs(f({{0, 0}})[2]), at("max_abs_p"), 1e-9 * at("max_abs_p"));
  }
  EXPECT_GE(data.rows, 100U);
}

TEST(TaylorGreen, SolvesTheNavierStokesEquations) {
  const TaylorGreen s{.U = 1.3, .L = 0.7, .rho = 1.9, .mu = 0.02};
  const double t = 0.31, d = 1e-3;
  const auto part = [&](std::size_t field, double x, double y, double at) { return s.at(at)({{x, y}})[field]; };
  for (const auto& place : {std::pair(0.11, 0.05), {0.4, 0.62}, {0.33, -0.2}}) {
    const double x = place.first, y = place.second;  // clang 14 lets no lambda capture a structured binding
    const auto in_x = [&](std::size_t f) { return slope([&](double a) { return part(f, a, y, t); }, x, d); };
    const auto in_y = [&](std::size_t f) { return slope([&](double a) { return part(f, x, a, t); }, y, d); };
    const double u = part(0, x, y, t), v = part(1, x, y, t);
    EXPECT_NEAR(in_x(0) + in_y(1), 0, 1e-8);
    for (const std::size_t k : {0U, 1U}) {
      const double in_t = slope([&](double a) { return part(k, x, y, a); }, t, d);
      const double laplacian = curvature([&](double a) { return part(k, a, y, t); }, x, d) +
                               curvature([&](double a) { return part(k, x, a, t); }, y, d);
      const double gradient = k == 0 ? in_x(2) : in_y(2);
      EXPECT_NEAR(s.rho * (in_t + u * in_x(k) + v * in_y(k)) + gradient - s.mu * laplacian, 0, 1e-6);
    }
  }
}

// Euler's equations with the force -B^2 r inside, no pressure on the ellipse, an ellipse that moves with the liquid,
// and energy kept.
TEST(DropInForce, SolvesEulersEquations) {
  const DropInForce s{.R = 0.8, .B = 1.3, .A_0 = 0.9, .rho = 900};
  const double d = 1e-3, energy = 2 * (sq(s.A_0) + sq(s.B));
  const auto part = [&](std::size_t field, double x, double y, double at) { return s.at(at)({{x, y}})[field]; };
  for (const double t : {0.02, 0.7, 1.6, 4.0}) {
    const auto [A, stretch] = s.state(t);
    const double a = s.R * stretch, b = s.R / stretch;
    EXPECT_NEAR((sq(A) + sq(s.B)) * (sq(stretch) + 1 / sq(stretch)), energy, 1e-8 * energy);
    EXPECT_NEAR(slope([&](double at) { return s.state(at).s; }, t, d), A * stretch, 1e-7);
    EXPECT_NEAR(part(2, a * std::cos(0.6), b * std::sin(0.6), t), 0, 1e-8);
    const double x = 0.4 * a, y = -0.5 * b;
    const auto in_x = [&](std::size_t f) { return slope([&](double at) { return part(f, at, y, t); }, x, d); };
    const auto in_y = [&](std::size_t f) { return slope([&](double at) { return part(f, x, at, t); }, y, d); };
    const double u = part(0, x, y, t), v = part(1, x, y, t);
    EXPECT_NEAR(in_x(0) + in_y(1), 0, 1e-9);
    for (const std::size_t k : {0U, 1U}) {
      const double in_t = slope([&](double at) { return part(k, x, y, at); }, t, d);
      const double pressure = k == 0 ? in_x(2) : in_y(2), place = k == 0 ? x : y;
      EXPECT_NEAR(in_t + u * in_x(k) + v * in_y(k) + pressure / s.rho + sq(s.B) * place, 0, 1e-6);
    }
  }
  EXPECT_NEAR(DropInForce{}.at(0)({{0, 0}})[2], 1000, 1e-9);  // A_0 = B = R = 1: p = 1000 (1 - r^2)
}

/// Compares a start-up flow with its table: t_s, y_m, u_m_per_s.
template <class Solution>
void compare_with_table(const char* file) {
  const CsvTable data = table(file);
  constexpr double V0 = 1.25e-5;
  for (std::size_t i = 0; i < data.rows; ++i) {
    const double t = data.column("t_s").values[i];
    // Rows without a time are the steady state.
    const auto f = Solution{}.at(std::isfinite(t) ? t : 1e4);
    EXPECT_NEAR(f({{data.column("y_m").values[i]}})[0], data.column("u_m_per_s").values[i], 1e-9 * V0);
  }
  EXPECT_GE(data.rows, 600U);
}

TEST(Couette, MeetsTheTable) { compare_with_table<Couette>("couette_startup.csv"); }
TEST(Poiseuille, MeetsTheTable) { compare_with_table<Poiseuille>("poiseuille_startup.csv"); }

/// v_t = nu v_yy + force within 1e-7 of the largest v_t of the channel.
template <class Solution>
void solves_the_diffusion_equation(const Solution& s, double force, double late) {
  const double nu = s.mu / s.rho;
  for (const double tau : {2e-4, 5e-4, 0.002, 0.01, 0.1, 0.5}) {
    const double t = tau * sq(s.L) / nu;
    if (t > late) continue;
    const auto v = [&](double y, double at) { return s.at(at)({{y}})[0]; };
    double scale = std::abs(force);
    std::vector<double> residuals;
    for (const double eta : {0.1, 0.3, 0.5, 0.9, 0.97}) {
      const double y = eta * s.L;
      const double in_t = slope([&](double at) { return v(y, at); }, t, 1e-3 * t);
      const double in_yy = curvature([&](double at) { return v(at, t); }, y, 1e-3 * s.L);
      scale = std::max(scale, std::abs(in_t));
      residuals.push_back(in_t - nu * in_yy - force);
    }
    for (const double residual : residuals) EXPECT_NEAR(residual, 0, 1e-5 * scale) << tau;
  }
}

TEST(Couette, SolvesTheDiffusionEquation) {
  const Couette s{.V = 2, .L = 0.5, .rho = 3, .mu = 0.1};
  solves_the_diffusion_equation(s, 0, 1e9);
}
TEST(Poiseuille, SolvesTheDiffusionEquation) {
  const Poiseuille s{.F = 2, .L = 0.5, .rho = 3, .mu = 0.1};
  solves_the_diffusion_equation(s, s.F, 1e9);
}

TEST(Couette, BothFormsAgreeWhereTheyMeet) {
  const Couette s{.V = 1, .L = 1, .rho = 1, .mu = 1};
  for (const double y : {0.0, 0.5, 0.9, 0.99, 1.0})
    EXPECT_NEAR(s.at(Couette::early * (1 - 1e-12))({{y}})[0], s.at(Couette::early * (1 + 1e-12))({{y}})[0], 1e-11);
}

TEST(Couette, KeepsToItsPlates) {
  const Couette s{.V = 1, .L = 1, .rho = 1, .mu = 1};
  for (const double t : {0.0, 1e-5, 1e-3, 0.1, 10.0}) {
    EXPECT_NEAR(s.at(t)({{0.0}})[0], 0, 1e-15);
    EXPECT_NEAR(s.at(t)({{1.0}})[0], 1, 1e-14);
    EXPECT_NEAR(s.at(t)({{1.1}})[0], 1, 1e-14);  // behind the plate
  }
}

// The fluid of the first moment falls freely: v = F t away from the plates, to what 400 terms leave.
TEST(Poiseuille, BeginsAsFreeFall) {
  const Poiseuille s{.F = 1, .L = 1, .rho = 1, .mu = 1};
  const double peak = s.steady(0.5);
  for (const double t : {0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) EXPECT_NEAR(s.at(t)({{0.5}})[0], t, 5e-7 * peak);
  EXPECT_NEAR(s.at(1e-4)({{0.5}})[0], 1e-4, 1e-14);
  EXPECT_NEAR(s.at(10)({{0.5}})[0], 1.0 / 8, 1e-15);
}

TEST(Hydrostatic, MeetsTheTable) {
  const CsvTable data = table("hydrostatic_column.csv");
  const double c10 = 10 * std::sqrt(9.81), c20 = 2 * c10;
  for (std::size_t i = 0; i < data.rows; ++i) {
    const auto at = [&](const char* name) { return data.column(name).values[i]; };
    const Point y{{at("y_m")}};
    EXPECT_NEAR(HydrostaticIncompressible{}.at(0)(y)[2], at("p_incompressible_Pa"), 1e-8);
    const auto check = [&](const auto& s, const char* rho, const char* p) {
      EXPECT_NEAR(s.at(0)(y)[0], at(rho), 1e-5);
      EXPECT_NEAR(s.at(0)(y)[2], at(p), 1e-5);
    };
    check(HydrostaticLinear{{}, c10}, "rho_lin_c10", "p_lin_c10");
    check(HydrostaticLinear{{}, c20}, "rho_lin_c20", "p_lin_c20");
    check(HydrostaticTait{{}, c10}, "rho_tait_c10", "p_tait_c10");
    check(HydrostaticTait{{}, c20}, "rho_tait_c20", "p_tait_c20");
  }
  EXPECT_EQ(data.rows, 51U);
}

// dp/dy = -rho g, and the pressure is that of the program's own equation of state.
TEST(Hydrostatic, BalancesAndFollowsTheEquationOfState) {
  const auto balance = [](const auto& s) {
    for (const double y : {-2.0, 0.0, 0.7}) {
      const auto p = [&](double at) { return s.at(0)({{at}})[2]; };
      const double weight = s.at(0)({{y}})[0] * s.g;
      EXPECT_NEAR(slope(p, y, 0.01), -weight, 1e-9 * weight);
    }
    EXPECT_EQ(s.at(0)({{s.surface}})[2], 0);
    EXPECT_EQ(s.at(0)({{s.surface + 0.1}})[0], 0);
  };
  balance(HydrostaticIncompressible{});
  const HydrostaticLinear linear{{.rho_0 = 900, .g = 3, .surface = 1.2}, 12};
  balance(linear);
  const HydrostaticTait tait{{.rho_0 = 900, .g = 3, .surface = 1.2}, 12, 5};
  balance(tait);
  balance(HydrostaticTait{{}, 30, 1});
  const auto [rho1, v1, p1] = linear.at(0)({{0.0}});
  EXPECT_NEAR((materials::Linear{.rho_0 = 900, .c_0 = 12}.pressure(rho1)), p1, 1e-9 * p1);
  const auto [rho2, v2, p2] = tait.at(0)({{0.0}});
  EXPECT_NEAR((materials::TaitSoundSpeed{.rho_0 = 900, .c_0 = 12, .gamma = 5}.pressure(rho2)), p2, 1e-9 * p2);
  const HydrostaticTait isothermal{{}, 30, 1}, nearly{{}, 30, 1 + 1e-9};
  EXPECT_NEAR(nearly.at(0)({{0.0}})[2], isothermal.at(0)({{0.0}})[2], 1e-4);
}

TEST(SoundWave, SolvesTheLinearEquations) {
  const SoundWave s{.rho_0 = 3, .c = 5, .U = 0.01, .L = 1.7, .n = 3};
  const double t = 0.123;
  const auto part = [&](std::size_t f, double x, double at) { return s.at(at)({{x}})[f]; };
  for (const double x : {0.2, 0.9, 1.6}) {
    const auto in_x = [&](std::size_t f) { return slope([&](double a) { return part(f, a, t); }, x, 1e-3); };
    const auto in_t = [&](std::size_t f) { return slope([&](double a) { return part(f, x, a); }, t, 1e-4); };
    EXPECT_NEAR(in_t(0) + s.rho_0 * in_x(1), 0, 1e-8);
    EXPECT_NEAR(s.rho_0 * in_t(1) + in_x(2), 0, 1e-8);
    EXPECT_NEAR(part(2, x, t), sq(s.c) * (part(0, x, t) - s.rho_0), 1e-12);
  }
  EXPECT_NEAR(part(1, 0, t), 0, 1e-16);
  EXPECT_NEAR(part(1, s.L, t), 0, 1e-16);
  EXPECT_THROW((SoundWave{.n = 1.5}.at(0)), InputError);
}

TEST(DropOscillation, MeetsTheTable) {
  const CsvTable data = read_csv(std::filesystem::path(UNDINE_TEST_DATA) / "exact/drop_modes.csv");
  for (std::size_t i = 0; i < data.rows; ++i) {
    const auto at = [&](const char* name) { return data.column(name).values[i]; };
    const DropOscillation s{
        .dimensions = at("dim"), .n = at("mode_n"), .sigma = 2, .rho = 3, .mu = 0.03, .R = 0.5, .a = 0.01};
    const double unit_frequency = std::sqrt(2 / (3 * cube(0.5)));
    const auto [omega, period, decay, radius] = s.at(0.1)({});
    EXPECT_NEAR(omega, at("c_n") * unit_frequency, 1e-8 * omega);
    EXPECT_NEAR(period, at("t_n") / unit_frequency, 1e-8 * period);
    EXPECT_NEAR(decay, at("d_n") * 0.01 / sq(0.5), 1e-12 * decay);
    EXPECT_NEAR(radius, 0.5 + 0.01 * std::cos(0.1 * omega) * std::exp(-0.1 * decay), 1e-15);
  }
  EXPECT_EQ(data.rows, 10U);
}

// The work of pressing the drop smaller is that of its surface: dE = p dV.
TEST(DropPressure, IsSurfaceEnergyPerVolume) {
  for (const double d : {2.0, 3.0}) {
    const DropPressure s{.dimensions = d, .sigma = 0.3, .R = 0.2, .p_out = 7};
    const auto surface = [&](double R) { return d == 2 ? 2 * pi * R : 4 * pi * R * R; };
    const auto volume = [&](double R) { return d == 2 ? pi * R * R : 4 * pi / 3 * R * R * R; };
    const double jump = s.sigma * slope(surface, s.R, 1e-3) / slope(volume, s.R, 1e-3);
    EXPECT_NEAR(s.at(0)({{0.19}})[1], 7 + jump, 1e-9);
    EXPECT_EQ(s.at(0)({{0.21}})[1], 7);
  }
}

/// The rows of one Reynolds number of a table in validation/cavity.
struct Line {
  std::vector<double> s, value;
};
Line cavity_line(const char* file, const char* place, const char* value, double Re) {
  const CsvTable data = read_csv(std::filesystem::path(UNDINE_SOURCE_DIR) / "validation/cavity" / file);
  Line line;
  for (std::size_t i = 0; i < data.rows; ++i) {
    if (data.column("Re").values[i] != Re || !std::isfinite(data.column(value).values[i])) continue;
    line.s.push_back(data.column(place).values[i]);
    line.value.push_back(data.column(value).values[i]);
  }
  return line;
}

TEST(Cavity, HoldsTheCorrectedTables) {
  std::size_t points = 0;
  for (const double Re : Cavity::reynolds()) {
    const auto f = Cavity{Re}.at(0);
    const Line u = cavity_line("lid_driven_cavity_u.csv", "y", "u_ghia_recommended", Re);
    const Line v = cavity_line("lid_driven_cavity_v.csv", "x", "v_ghia_recommended", Re);
    for (std::size_t i = 0; i < u.s.size(); ++i) EXPECT_EQ(f({{u.s[i]}})[0], u.value[i]) << Re << " " << u.s[i];
    for (std::size_t i = 0; i < v.s.size(); ++i) EXPECT_EQ(f({{v.s[i]}})[1], v.value[i]) << Re << " " << v.s[i];
    points += u.s.size() + v.s.size();
  }
  EXPECT_EQ(points, 7U * 34 - 1);
  EXPECT_NEAR(Cavity{400}.at(0)({{0.9063}})[1], -0.38969, 1e-12);
  EXPECT_THROW(Cavity{500}.at(0), InputError);
}

// Between the points the curves stay within 0.04 of an independent solution with errors below 3e-5; Ghia's points
// themselves are up to 0.018 off it.
TEST(Cavity, FollowsAnIndependentSolution) {
  for (const double Re : {100.0, 400.0, 1000.0}) {
    const auto f = Cavity{Re}.at(0);
    for (const auto& [name, field] : {std::pair("u", 0U), {"v", 1U}}) {
      const Line line = cavity_line("lid_driven_cavity_own_profiles.csv", "s", name, Re);
      double largest = 0;
      for (std::size_t i = 0; i < line.s.size(); ++i)
        largest = std::max(largest, std::abs(f({{line.s[i]}})[field] - line.value[i]));
      EXPECT_LT(largest, 0.04) << Re << " " << name;
      EXPECT_EQ(line.s.size(), 129U);
    }
  }
}

// Every entry: the defaults make a solution, with finite values at its example and one number per field.
TEST(ExactSolutions, ShowTheirExamples) {
  ExactSolutions::for_each([]<class S>(S s) {
    SCOPED_TRACE(std::string(S::info.name));
    const auto f = s.at(S::example.time);
    for (const double share : {0.0, 0.37, 1.0}) {
      const auto values = f((1 - share) * S::example.from + share * S::example.to);
      static_assert(values.size() == S::fields.size());
      for (const double value : values) EXPECT_TRUE(std::isfinite(value));
    }
    EXPECT_GT(S::parameters().size(), 0U);
  });
}

// Numbers with units scale: a solution in other units of mass, length and time is the same solution.
TEST(ExactSolutions, KeepTheirDimensions) {
  const auto scaled = [](const auto& s, const auto& big, double length, double time, auto check) {
    check(s.at(0.3)({{0.2}}), big.at(0.3 * time)({{0.2 * length}}));
  };
  // Length x2, time x5, mass x3 in 3-D: velocity 2/5, density 3/8, pressure 3/(2*25), energy 3*4/25.
  scaled(Sedov{}, Sedov{.E = 12.0 / 25, .rho_0 = 3.0 / 8}, 2, 5, [](const auto& a, const auto& b) {
    EXPECT_NEAR(b[0], a[0] * 3 / 8, 1e-12);
    EXPECT_NEAR(b[1], a[1] * 2 / 5, 1e-12);
    EXPECT_NEAR(b[2], a[2] * 3 / 50, 1e-12);
    EXPECT_NEAR(b[3], a[3] * 4 / 25, 1e-12);
  });
  scaled(Noh{}, Noh{.rho_0 = 3.0 / 8, .v_0 = 0.4}, 2, 5, [](const auto& a, const auto& b) {
    EXPECT_NEAR(b[0], a[0] * 3 / 8, 1e-12);
    EXPECT_NEAR(b[2], a[2] * 3 / 50, 1e-12);
  });
}

}  // namespace
}  // namespace undine::exact
