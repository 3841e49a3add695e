#pragma once
#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// Decaying vortices in a periodic square: an exact solution of the incompressible Navier-Stokes equations.
struct TaylorGreen {
  static constexpr Info info{
      "taylor_green", "Decaying vortices in a periodic square (Taylor-Green), 2-D",
      "v = U e^(bt) (-cos kx sin ky, sin kx cos ky), p = -rho U^2/4 e^(2bt) (cos 2kx + cos 2ky), k = 2 pi/L, "
      "b = -2 k^2 mu/rho",
      "Taylor and Green (1937)"};
  static constexpr Frame frame = Frame::plane;
  static constexpr std::array coordinates{std::string_view("x"), std::string_view("y")};
  static constexpr std::array fields{name::velocity_x, name::velocity_y, name::pressure};
  static constexpr Example example{{{0.0, 0.25}}, {{1.0, 0.25}}, 0.5};

  double U = 1;
  double L = 1;
  double rho = 1;
  double mu = 0.01;
  static constexpr auto parameters() {
    using P = Parameter<TaylorGreen>;
    return std::array{P{"speed", &TaylorGreen::U, "m/s", "U, the largest at the start"},
                      P{"length", &TaylorGreen::L, "m", "L, the period", 1e-300},
                      P{"density", &TaylorGreen::rho, "kg/m^3", "rho", 1e-300},
                      P{"viscosity", &TaylorGreen::mu, "Pa s", "mu; Re = rho U L/mu", 0}};
  }

  auto at(double t) const {
    const double k = 2 * pi / L, decay = std::exp(-2 * sq(k) * mu / rho * t);
    return [k, decay, *this](const Point& x) {
      const double X = k * x[0], Y = k * x[1];
      return Values<3>{-U * decay * std::cos(X) * std::sin(Y), U * decay * std::sin(X) * std::cos(Y),
                       -rho * sq(U * decay) / 4 * (std::cos(2 * X) + std::cos(2 * Y))};
    };
  }
};

}  // namespace undine::exact
