#pragma once
#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// The limit of small amplitude: exact as U/c goes to 0, off by the order of (U/c)^2 otherwise.
struct SoundWave {
  static constexpr Info info{"sound_wave", "Linear standing sound wave between two walls, or in a period of 2 L/n",
                             "v = U sin kx cos(c k t), p = -rho_0 c U cos kx sin(c k t), rho = rho_0 + p/c^2, "
                             "k = n pi/L",
                             "Lamb (1932), art. 277"};
  static constexpr Frame frame = Frame::line;
  static constexpr std::array coordinates{std::string_view("x")};
  static constexpr std::array fields{name::density, name::velocity, name::pressure};
  static constexpr Example example{{{0.0}}, {{1.0}}, 0.02};

  double rho_0 = 1000;
  double c = 30;
  double U = 1e-3;
  double L = 1;
  double n = 1;
  static constexpr auto parameters() {
    using P = Parameter<SoundWave>;
    return std::array{P{"density", &SoundWave::rho_0, "kg/m^3", "rho_0", 1e-300},
                      P{"sound_speed", &SoundWave::c, "m/s", "c", 1e-300},
                      P{"amplitude", &SoundWave::U, "m/s", "U, largest velocity, small against c"},
                      P{"length", &SoundWave::L, "m", "L, from the wall x = 0 to the wall x = L", 1e-300},
                      P{"mode", &SoundWave::n, "1", "n, half waves between the walls", 1}};
  }

  auto at(double t) const {
    const double k = whole("mode", n, 1) * pi / L;
    return [k, t, *this](const Point& x) {
      const double p = -rho_0 * c * U * std::cos(k * x[0]) * std::sin(c * k * t);
      return Values<3>{rho_0 + p / sq(c), U * std::sin(k * x[0]) * std::cos(c * k * t), p};
    };
  }
};

}  // namespace undine::exact
