#pragma once
#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// Small oscillations of a free drop (3-D) or of a free cylinder of liquid (2-D) in a vacuum.
struct DropOscillation {
  static constexpr Info info{
      "drop_oscillation", "Oscillation of a free drop under surface tension, 2-D and 3-D",
      "omega^2 = n (n^2-1) sigma/(rho R^3) (2-D), n (n-1) (n+2) sigma/(rho R^3) (3-D); the radius at the pole is "
      "R + a cos(omega t) exp(-b t), b = 2 n (n-1) nu/R^2 (2-D), (n-1) (2n+1) nu/R^2 (3-D)",
      "Rayleigh (1879); Lamb (1932), art. 273, 275, 355; for a << R and b << omega"};
  static constexpr Frame frame = Frame::time;
  static constexpr std::array<std::string_view, 0> coordinates{};
  static constexpr std::array fields{FieldLine{"angular_frequency", "rad/s"}, FieldLine{"period", "s"},
                                     FieldLine{"decay_rate", "1/s"}, FieldLine{"radius", "m"}};
  static constexpr Example example{{}, {}, 0};

  double dimensions = 3;
  double n = 2;
  double sigma = 0.0728;
  double rho = 1000;
  double mu = 0;
  double R = 1e-3;
  double a = 1e-5;
  static constexpr auto parameters() {
    using P = Parameter<DropOscillation>;
    return std::array{P{"dimensions", &DropOscillation::dimensions, "1", "2: cylinder, 3: sphere", 2, 3},
                      P{"mode", &DropOscillation::n, "1", "n, from 2: waves round the drop", 2},
                      P{"surface_tension", &DropOscillation::sigma, "N/m", "sigma", 1e-300},
                      P{"density", &DropOscillation::rho, "kg/m^3", "rho", 1e-300},
                      P{"viscosity", &DropOscillation::mu, "Pa s", "mu = rho nu, small", 0},
                      P{"radius", &DropOscillation::R, "m", "R, at rest", 1e-300},
                      P{"amplitude", &DropOscillation::a, "m", "a, small against R"}};
  }

  auto at(double t) const {
    const int d = whole_dimensions(dimensions, 2), k = whole("mode", n, 2);
    const double factor = d == 2 ? k * (sq(n) - 1) : k * (n - 1) * (n + 2);
    const double omega = std::sqrt(factor * sigma / (rho * cube(R)));
    const double decay = (d == 2 ? 2 * n * (n - 1) : (n - 1) * (2 * n + 1)) * mu / (rho * sq(R));
    const double radius = R + a * std::cos(omega * t) * std::exp(-decay * t);
    return [=](const Point&) { return Values<4>{omega, 2 * pi / omega, decay, radius}; };
  }
};

/// A drop or a cylinder of liquid at rest: the pressure that surface tension makes inside.
struct DropPressure {
  static constexpr Info info{"drop_pressure", "Drop at rest: pressure by surface tension, 2-D and 3-D",
                             "p = p_out + (d-1) sigma/R for r < R, p_out outside", "Young (1805), Laplace (1806)"};
  static constexpr Frame frame = Frame::radius;
  static constexpr std::array coordinates{std::string_view("r")};
  static constexpr std::array fields{name::velocity, name::pressure};
  static constexpr Example example{{{0.0}}, {{2e-3}}, 0};

  double dimensions = 3;
  double sigma = 0.0728;
  double R = 1e-3;
  double p_out = 0;
  static constexpr auto parameters() {
    using P = Parameter<DropPressure>;
    return std::array{P{"dimensions", &DropPressure::dimensions, "1", "d, 2: cylinder, 3: sphere", 2, 3},
                      P{"surface_tension", &DropPressure::sigma, "N/m", "sigma", 0},
                      P{"radius", &DropPressure::R, "m", "R", 1e-300},
                      P{"pressure_outside", &DropPressure::p_out, "Pa", "p_out"}};
  }

  auto at(double) const {
    const double jump = (whole_dimensions(dimensions, 2) - 1) * sigma / R;
    return [jump, *this](const Point& x) { return Values<2>{0, std::abs(x[0]) < R ? p_out + jump : p_out}; };
  }
};

}  // namespace undine::exact
