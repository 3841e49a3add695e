#pragma once
#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// Gas on one side of the diaphragm.
struct GasState {
  double rho, v, p;
};

/// What the waves of a Riemann problem enclose, sampled along x/t. A left and a right wave (shock or fan), the contact
/// between them; a vacuum between two fans where they tear apart, or beside one where a side begins empty.
class RiemannFan {
 public:
  RiemannFan(const GasState& left, const GasState& right, double gamma);

  /// The state on the ray x/t = s; in a vacuum everything is 0.
  GasState operator()(double s) const;

  bool vacuum() const { return vacuum_; }
  double p() const { return p_; }  ///< between the waves; 0 with a vacuum
  double v() const { return v_; }  ///< of the contact

 private:
  /// Mirrors the right side into a left one, so that there is one set of equations.
  GasState left_wave(GasState k, double s, double v_star) const;

  GasState left_, right_;
  double gamma_;
  bool vacuum_ = false;
  double p_ = 0, v_ = 0;
};

/// The Riemann problem of an ideal gas.
struct Riemann {
  static constexpr Info info{
      "riemann", "Shock tube: two states of an ideal gas beside each other (Riemann problem)",
      "rho_t + (rho v)_x = 0, (rho v)_t + (rho v^2 + p)_x = 0, E_t + ((E + p) v)_x = 0, E = rho (v^2/2 + e), "
      "p = (gamma-1) rho e; p* from f_L(p*) + f_R(p*) + v_R - v_L = 0",
      "Toro (2009), ch. 4; defaults: Sod (1978)"};
  static constexpr Frame frame = Frame::line;
  static constexpr std::array coordinates{std::string_view("x")};
  static constexpr std::array fields{name::density, name::velocity, name::pressure, name::energy};
  static constexpr Example example{{{-0.5}}, {{0.5}}, 0.2};

  double rho_left = 1, v_left = 0, p_left = 1;
  double rho_right = 0.125, v_right = 0, p_right = 0.1;
  double gamma = 1.4;
  double diaphragm = 0;
  static constexpr auto parameters() {
    using P = Parameter<Riemann>;
    return std::array{P{"rho_left", &Riemann::rho_left, "kg/m^3", "density at x < diaphragm; 0: vacuum", 0},
                      P{"v_left", &Riemann::v_left, "m/s", "velocity there"},
                      P{"p_left", &Riemann::p_left, "Pa", "pressure there", 0},
                      P{"rho_right", &Riemann::rho_right, "kg/m^3", "density at x > diaphragm; 0: vacuum", 0},
                      P{"v_right", &Riemann::v_right, "m/s", "velocity there"},
                      P{"p_right", &Riemann::p_right, "Pa", "pressure there", 0},
                      P{"gamma", &Riemann::gamma, "1", "ratio of specific heats, above 1", 1},
                      P{"diaphragm", &Riemann::diaphragm, "m", "where the states meet"}};
  }

  RiemannFan fan() const;
  auto at(double t) const {
    return [waves = fan(), t, *this](const Point& x) {
      // At t = 0 the rays are the two sides.
      const double d = x[0] - diaphragm;
      const GasState s = waves(t > 0 ? d / t : std::copysign(INFINITY, d));
      return Values<4>{s.rho, s.v, s.p, internal_energy(s.rho, s.p, gamma)};
    };
  }
};

}  // namespace undine::exact
