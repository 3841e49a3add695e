#pragma once
#include "undine/analysis/exact/solution.hpp"

/// Liquid at rest below a free surface with p = 0 and rho = rho_0: dp/dy = -rho g, y upwards. Above the surface there
/// is nothing, and every field is 0. With the enthalpy i = int dp/rho the balance reads i(rho) = g (surface - y).
namespace undine::exact {

/// What these columns have in common.
struct Column {
  static constexpr Frame frame = Frame::line;
  static constexpr std::array coordinates{std::string_view("y")};
  static constexpr std::array fields{name::density, name::velocity, name::pressure};
  static constexpr Example example{{{0.0}}, {{1.0}}, 0};

  double rho_0 = 1000;
  double g = 9.81;
  double surface = 1;

  double depth(const Point& y) const { return surface - y[0]; }

  /// The parameters of the column S: these, and `more`.
  template <class S, class... More>
  static constexpr auto parameters_of(std::string_view rho_0_means, More... more) {
    using P = Parameter<S>;
    return std::array{P{"density", &S::rho_0, "kg/m^3", rho_0_means, 1e-300},
                      P{"gravity", &S::g, "m/s^2", "g, towards smaller y", 0},
                      P{"surface", &S::surface, "m", "height of the free surface"}, more...};
  }
};

struct HydrostaticIncompressible : Column {
  static constexpr Info info{"hydrostatic_incompressible", "Liquid at rest, incompressible",
                             "p = rho_0 g (surface - y)", "Stevin (1586)"};

  static constexpr auto parameters() { return parameters_of<HydrostaticIncompressible>("rho_0"); }

  auto at(double) const {
    return [*this](const Point& y) {
      const double d = depth(y);
      return d < 0 ? Values<3>{} : Values<3>{rho_0, 0, rho_0 * g * d};
    };
  }
};

struct HydrostaticLinear : Column {
  static constexpr Info info{"hydrostatic_linear", "Liquid at rest, equation of state `linear`",
                             "rho = rho_0 exp(g (surface - y)/c_0^2), p = c_0^2 (rho - rho_0)",
                             "dp/dy = -rho g with p = c_0^2 (rho - rho_0)"};

  double c_0 = 30;
  static constexpr auto parameters() {
    return parameters_of<HydrostaticLinear>(
        "rho_0, at the surface",
        Parameter<HydrostaticLinear>{"sound_speed", &HydrostaticLinear::c_0, "m/s", "c_0", 1e-300});
  }

  auto at(double) const {
    return [*this](const Point& y) {
      const double d = depth(y);
      if (d < 0) return Values<3>{};
      const double strain = std::expm1(g * d / sq(c_0));  // rho/rho_0 - 1
      return Values<3>{rho_0 * (1 + strain), 0, sq(c_0) * rho_0 * strain};
    };
  }
};

struct HydrostaticTait : Column {
  static constexpr Info info{
      "hydrostatic_tait", "Liquid at rest, equation of state `tait_sound_speed`",
      "rho = rho_0 (1 + (gamma-1) g (surface - y)/c_0^2)^(1/(gamma-1)), p = rho_0 c_0^2/gamma ((rho/rho_0)^gamma - 1)",
      "dp/dy = -rho g with Monaghan (1994), eq. 6"};

  double c_0 = 30;
  double gamma = 7;
  static constexpr auto parameters() {
    using P = Parameter<HydrostaticTait>;
    return parameters_of<HydrostaticTait>("rho_0, at the surface",
                                          P{"sound_speed", &HydrostaticTait::c_0, "m/s", "c_0, at the surface", 1e-300},
                                          P{"gamma", &HydrostaticTait::gamma, "1", "exponent", 1});
  }

  auto at(double) const {
    return [*this](const Point& y) {
      const double d = depth(y);
      if (d < 0) return Values<3>{};
      const double s = g * d / sq(c_0);
      // ln(rho/rho_0); the limit gamma = 1 is the isothermal liquid.
      const double strain = gamma == 1 ? s : std::log1p((gamma - 1) * s) / (gamma - 1);
      return Values<3>{rho_0 * std::exp(strain), 0, rho_0 * sq(c_0) / gamma * std::expm1(gamma * strain)};
    };
  }
};

}  // namespace undine::exact
