#pragma once
#include <algorithm>

#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// A drop without viscosity and surface tension, held together by a force -B^2 r and stretched at the start by
/// v = A_0 (x, -y). The velocity stays linear in space, so the drop stays an ellipse with half-axes a = R s, b = R/s,
/// and Euler's equations come down to two ordinary ones, for A and s. (A^2 + B^2)(s^2 + 1/s^2), the energy, is
/// constant.
struct DropInForce {
  static constexpr Info info{"drop_in_force", "Drop that oscillates in a central force, 2-D",
                             "v = A (x, -y), p = rho C/2 (1 - x^2/a^2 - y^2/b^2), C = 2 (A^2+B^2) a^2 b^2/(a^2+b^2), "
                             "a = R s, b = R/s, ds/dt = A s, dA/dt = (A^2+B^2) (1-s^4)/(1+s^4)",
                             "Monaghan and Rafiee (2013); Antuono et al. (2015)"};
  static constexpr Frame frame = Frame::plane;
  static constexpr std::array coordinates{std::string_view("x"), std::string_view("y")};
  static constexpr std::array fields{name::velocity_x, name::velocity_y, name::pressure};
  static constexpr Example example{{{0.0, 0.0}}, {{1.0, 0.0}}, 1};

  double R = 1;
  double B = 1;
  double A_0 = 1;
  double rho = 1000;
  static constexpr auto parameters() {
    using P = Parameter<DropInForce>;
    return std::array{P{"radius", &DropInForce::R, "m", "R, of the circle at the start", 1e-300},
                      P{"force", &DropInForce::B, "1/s", "B; the force is -B^2 r", 1e-300},
                      P{"stretching", &DropInForce::A_0, "1/s", "A_0, rate at the start"},
                      P{"density", &DropInForce::rho, "kg/m^3", "rho", 1e-300}};
  }

  /// The rate A and the stretch s at a time, by Runge-Kutta steps of 1/400 of the faster time scale (error 1e-10).
  struct State {
    double A, s;
  };
  State state(double t) const {
    const auto rates = [this](State q) {
      const double s4 = sq(sq(q.s));
      return State{(sq(q.A) + sq(B)) * (1 - s4) / (1 + s4), q.A * q.s};
    };
    const auto moved = [](State q, double dt, State r) { return State{q.A + dt * r.A, q.s + dt * r.s}; };
    const double steps = std::ceil(400 * t * std::max(std::abs(A_0), B));
    State q{A_0, 1};
    for (double k = 0; k < steps; ++k) {
      const double dt = t / steps;
      const State r1 = rates(q), r2 = rates(moved(q, dt / 2, r1)), r3 = rates(moved(q, dt / 2, r2)),
                  r4 = rates(moved(q, dt, r3));
      q = {q.A + dt / 6 * (r1.A + 2 * r2.A + 2 * r3.A + r4.A), q.s + dt / 6 * (r1.s + 2 * r2.s + 2 * r3.s + r4.s)};
    }
    return q;
  }

  auto at(double t) const {
    const auto [A, s] = state(t);
    const double a = R * s, b = R / s, C = 2 * (sq(A) + sq(B)) * sq(a * b) / (sq(a) + sq(b));
    return [A = A, a, b, C, rho = rho](const Point& x) {
      const double inside = 1 - sq(x[0] / a) - sq(x[1] / b);
      return Values<3>{A * x[0], -A * x[1], rho * C / 2 * std::max(inside, 0.0)};
    };
  }
};

}  // namespace undine::exact
