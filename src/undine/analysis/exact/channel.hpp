#pragma once
#include <algorithm>

#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// Most terms of a series. Term n carries exp(-n^2 pi^2 nu t/L^2), so at nu t/L^2 >= 3e-5 the last one is below 1e-17;
/// a sum stops earlier, at the first factor below that.
inline constexpr int series_terms = 400;
inline constexpr double last_exponent = 40;  ///< exp(-40) = 4e-18

/// Between two plates at rest, driven by a body force from t = 0 on.
struct Poiseuille {
  static constexpr Info info{
      "poiseuille", "Start-up of the flow between two plates under a body force (plane Poiseuille)",
      "v = F/(2 nu) y (L-y) - sum_n 4 F L^2/(nu pi^3 n^3) sin(n pi y/L) exp(-n^2 pi^2 nu t/L^2), n = 1, 3, 5, ... "
      "(400 terms; cut off by less than 5e-7 of the final peak, by rounding alone from nu t/L^2 = 1e-5)",
      "Morris et al. (1997)"};
  static constexpr Frame frame = Frame::shear;
  static constexpr std::array coordinates{std::string_view("y")};
  static constexpr std::array fields{name::velocity};
  static constexpr Example example{{{0.0}}, {{1e-3}}, 0.1};

  double F = 1e-4;
  double L = 1e-3;
  double rho = 1000;
  double mu = 1e-3;
  static constexpr auto parameters() {
    using P = Parameter<Poiseuille>;
    return std::array{P{"force", &Poiseuille::F, "m/s^2", "F, per mass, along the plates"},
                      P{"width", &Poiseuille::L, "m", "L, from the plate y = 0 to the plate y = L", 1e-300},
                      P{"density", &Poiseuille::rho, "kg/m^3", "rho; nu = mu/rho", 1e-300},
                      P{"viscosity", &Poiseuille::mu, "Pa s", "mu", 1e-300}};
  }

  double steady(double y) const { return F * rho / (2 * mu) * y * (L - y); }
  auto at(double t) const {
    return [t, *this](const Point& x) {
      const double y = std::clamp(x[0], 0.0, L);  // what is behind a plate moves with it
      if (!(t > 0)) return Values<1>{0};
      const double nu = mu / rho, tau = nu * t / sq(L);
      double sum = 0;
      for (int k = 0; k < series_terms; ++k) {
        const double n = 2 * k + 1, exponent = sq(n * pi) * tau;
        if (exponent > last_exponent) break;
        sum += std::sin(n * pi * y / L) * std::exp(-exponent) / cube(n);
      }
      return Values<1>{steady(y) - 4 * F * sq(L) / (nu * cube(pi)) * sum};
    };
  }
};

/// Between a plate at rest and one that moves along itself from t = 0 on.
struct Couette {
  static constexpr Info info{
      "couette", "Start-up of the flow between a plate at rest and a moving one (plane Couette)",
      "v = V y/L + sum_n 2 V/(n pi) (-1)^n sin(n pi y/L) exp(-n^2 pi^2 nu t/L^2) (400 terms, exact but for rounding; "
      "for nu t/L^2 < 1e-3 V erfc((L-y)/(2 sqrt(nu t))), which differs by less than 1e-100)",
      "Morris et al. (1997)"};
  static constexpr Frame frame = Frame::shear;
  static constexpr std::array coordinates{std::string_view("y")};
  static constexpr std::array fields{name::velocity};
  static constexpr Example example{{{0.0}}, {{1e-3}}, 0.1};

  double V = 1.25e-5;
  double L = 1e-3;
  double rho = 1000;
  double mu = 1e-3;
  static constexpr auto parameters() {
    using P = Parameter<Couette>;
    return std::array{P{"speed", &Couette::V, "m/s", "V, of the plate y = L"},
                      P{"width", &Couette::L, "m", "L, from the plate y = 0 to the plate y = L", 1e-300},
                      P{"density", &Couette::rho, "kg/m^3", "rho; nu = mu/rho", 1e-300},
                      P{"viscosity", &Couette::mu, "Pa s", "mu", 1e-300}};
  }

  static constexpr double early = 1e-3;  ///< nu t/L^2, below which the plate at rest is not felt yet
  auto at(double t) const {
    return [t, *this](const Point& x) {
      const double y = std::clamp(x[0], 0.0, L), tau = mu / rho * t / sq(L);
      if (!(t > 0)) return Values<1>{y < L ? 0 : V};
      if (tau < early) return Values<1>{V * std::erfc((1 - y / L) / (2 * std::sqrt(tau)))};
      double sum = 0;
      for (int n = 1; n <= series_terms; ++n) {
        const double exponent = sq(n * pi) * tau;
        if (exponent > last_exponent) break;
        sum += (n % 2 ? -1 : 1) * std::sin(n * pi * y / L) * std::exp(-exponent) / n;
      }
      return Values<1>{V * (y / L + 2 / pi * sum)};
    };
  }
};

}  // namespace undine::exact
