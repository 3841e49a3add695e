#pragma once
#include <vector>

#include "undine/analysis/exact/solution.hpp"

namespace undine::exact {

/// Similarity solution of a strong blast, in lambda = r/R and V = v t/(delta r), delta = 2/(d+2).
///
/// The energy inside every sphere lambda = const keeps its value, which gives with the momentum equation
///   z = gamma p t^2/(rho delta^2 r^2) = gamma (gamma-1)/2 V^2 (1-V)/(gamma V-1)
///   L = dV/dln lambda = [V/delta - V^2 - z/gamma (d V/(1-V) + 2)] / [V - 1 + z/(gamma (1-V)) + z'(V)/gamma]
/// It is integrated inwards over the logarithm of m, the share of the swept mass inside lambda, with
///   dln lambda/dln m = (1-V)/d,   rho = rho_0 m/(lambda^d (1-V)),
/// which has no singular point for any gamma (in 3-D: up to 7, above which the centre is empty).
class SedovProfile {
 public:
  SedovProfile(int dimensions, double gamma);

  /// In units of r delta/t, rho_0, rho_0 S^2, S^2, with S = delta R/t the speed of the shock.
  struct Shape {
    double V, rho, p, e;
  };
  /// 0 <= lambda <= 1. Closer to the centre than 1e-12: what is there, for rho = 0 and e infinite at 0.
  Shape operator()(double lambda) const;

  /// E = alpha rho_0 R^(d+2)/t^2, E the whole energy (in 1-D per area and of both sides, in 2-D per length).
  double alpha() const { return alpha_; }
  double kinetic_share() const { return kinetic_share_; }
  double delta() const { return 2.0 / (d_ + 2); }

 private:
  struct Node {
    double ln_lambda, w, ln_m;   ///< w = ln(gamma V - 1), which stays exact where V comes close to 1/gamma
    double w_slope, ln_m_slope;  ///< over ln_lambda
  };
  struct Rates {
    double ln_lambda, w;  ///< over ln m
  };
  double V(double w) const { return (1 + std::exp(w)) / gamma_; }
  /// ln of z(V), above.
  double ln_z(double w) const;
  Rates rates(double w) const;
  void integrate();

  int d_;
  double gamma_;
  double alpha_ = 0, kinetic_share_ = 0;
  std::vector<Node> nodes_;  ///< from the shock inwards
};

/// A point (line, plane) explosion in a cold gas at rest.
struct Sedov {
  static constexpr Info info{
      "sedov", "Strong blast from a point, a line or a plane (Sedov-Taylor), 1-D to 3-D",
      "R = (E t^2/(alpha rho_0))^(1/(d+2)); behind the shock v = delta r V/t, rho = rho_0 m/(lambda^d (1-V)), "
      "p = rho (delta r/t)^2 (gamma-1)/2 V^2 (1-V)/(gamma V-1)",
      "Sedov (1959), ch. IV; Kamm and Timmes (2007)"};
  static constexpr Frame frame = Frame::radius;
  static constexpr std::array coordinates{std::string_view("r")};
  static constexpr std::array fields{name::density, name::velocity, name::pressure, name::energy};
  static constexpr Example example{{{0.0}}, {{0.5}}, 0.05};

  double dimensions = 3;
  double gamma = 5.0 / 3;
  double E = 1;
  double rho_0 = 1;
  static constexpr auto parameters() {
    using P = Parameter<Sedov>;
    return std::array{P{"dimensions", &Sedov::dimensions, "1", "d: 1 plane, 2 cylinder, 3 sphere", 1, 3},
                      P{"gamma", &Sedov::gamma, "1", "ratio of specific heats, above 1; in 3-D at most 7", 1},
                      P{"energy", &Sedov::E, "SI", "E, all of it: J; in 2-D J/m, in 1-D J/m^2 of both sides", 1e-300},
                      P{"density", &Sedov::rho_0, "kg/m^3", "rho_0, of the gas around", 1e-300}};
  }

  SedovProfile profile() const;
  double shock_radius(double t, double alpha) const {
    return std::pow(E * t * t / (alpha * rho_0), 1 / (dimensions + 2));
  }
  auto at(double t) const {
    const SedovProfile shape = profile();
    const double R = t > 0 ? shock_radius(t, shape.alpha()) : 0;
    const double S = R > 0 ? shape.delta() * R / t : 0;
    return [shape, R, S, t, *this](const Point& x) {
      const double r = std::abs(x[0]);
      if (!(r <= R) || R == 0) return Values<4>{rho_0, 0, 0, 0};
      const auto [V, rho, p, e] = shape(r / R);
      return Values<4>{rho_0 * rho, shape.delta() * x[0] / t * V, rho_0 * sq(S) * p, sq(S) * e};
    };
  }
};

}  // namespace undine::exact
