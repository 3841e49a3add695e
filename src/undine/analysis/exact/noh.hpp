#pragma once
#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// Cold gas that runs everywhere towards a plane, a line or a point at the speed v_0, and is stopped by a shock.
struct Noh {
  static constexpr Info info{
      "noh", "Cold gas running into its centre (Noh), 1-D to 3-D",
      "shock at r = (gamma-1)/2 v_0 t; behind rho = rho_0 ((gamma+1)/(gamma-1))^d, v = 0, e = v_0^2/2; "
      "ahead rho = rho_0 (1 + v_0 t/r)^(d-1), v = -v_0, p = 0",
      "Noh (1987)"};
  static constexpr Frame frame = Frame::radius;
  static constexpr std::array coordinates{std::string_view("r")};
  static constexpr std::array fields{name::density, name::velocity, name::pressure, name::energy};
  static constexpr Example example{{{0.0}}, {{1.0}}, 0.6};

  double dimensions = 3;
  double gamma = 5.0 / 3;
  double rho_0 = 1;
  double v_0 = 1;
  static constexpr auto parameters() {
    using P = Parameter<Noh>;
    return std::array{P{"dimensions", &Noh::dimensions, "1", "d: 1 plane, 2 cylinder, 3 sphere", 1, 3},
                      P{"gamma", &Noh::gamma, "1", "ratio of specific heats, above 1", 1},
                      P{"density", &Noh::rho_0, "kg/m^3", "rho_0, at the start", 1e-300},
                      P{"speed", &Noh::v_0, "m/s", "v_0, towards the centre", 1e-300}};
  }

  auto at(double t) const {
    const int d = whole_dimensions(dimensions);
    if (!(gamma > 1))
      no_solution(info.name, "gamma is not above 1", "p = (gamma-1) rho e would be no pressure", "give 5/3 as Noh");
    return [d, t, *this](const Point& x) {
      const double r = std::abs(x[0]);
      if (r < (gamma - 1) / 2 * v_0 * t) {
        const double rho = rho_0 * std::pow((gamma + 1) / (gamma - 1), d), e = sq(v_0) / 2;
        return Values<4>{rho, 0, (gamma - 1) * rho * e, e};
      }
      const double rho = d == 1 || t == 0 ? rho_0 : rho_0 * std::pow(1 + v_0 * t / r, d - 1);
      return Values<4>{rho, x[0] < 0 ? v_0 : -v_0, 0, 0};
    };
  }
};

}  // namespace undine::exact
