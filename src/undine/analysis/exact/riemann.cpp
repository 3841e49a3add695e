#include "undine/analysis/exact/riemann.hpp"

#include <algorithm>
#include <limits>

namespace undine::exact {
namespace {

double sound_speed(const GasState& k, double gamma) { return k.rho > 0 ? std::sqrt(gamma * k.p / k.rho) : 0; }

/// Change of velocity through the wave that takes the pressure of k to p, and its slope. Toro (2009), eqs. 4.6, 4.37.
struct Wave {
  double change, slope;
};
Wave wave(const GasState& k, double p, double gamma) {
  if (p > k.p) {  // shock
    const double a = 2 / ((gamma + 1) * k.rho), b = (gamma - 1) / (gamma + 1) * k.p;
    const double root = std::sqrt(a / (p + b));
    return {(p - k.p) * root, root * (1 - (p - k.p) / (2 * (p + b)))};
  }
  const double c = sound_speed(k, gamma);  // fan
  const double ratio = p / k.p;
  return {2 * c / (gamma - 1) * (std::pow(ratio, (gamma - 1) / (2 * gamma)) - 1),
          std::pow(ratio, -(gamma + 1) / (2 * gamma)) / (k.rho * c)};
}

/// The root of f(p) = f_L + f_R + v_R - v_L, which rises and is concave: Newton steps from below never overshoot, and
/// those from above are caught by the bracket.
double star_pressure(const GasState& left, const GasState& right, double gamma) {
  const auto f = [&](double p) {
    const Wave l = wave(left, p, gamma), r = wave(right, p, gamma);
    return Wave{l.change + r.change + right.v - left.v, l.slope + r.slope};
  };
  // Scale of the answer where both sides are cold.
  const double ram = std::min(left.rho, right.rho) * sq(left.v - right.v);
  double low = 0, high = std::max({left.p, right.p, ram});
  if (!(high > 0)) return 0;
  while (f(high).change < 0) {
    low = high;
    high *= 4;
  }
  double p = high;
  constexpr double precision = 4 * std::numeric_limits<double>::epsilon();
  for (int k = 0; k < 200; ++k) {
    const auto [value, slope] = f(p);
    (value < 0 ? low : high) = p;
    double next = p - value / slope;
    if (!(next > low && next < high)) next = low > 0 ? std::sqrt(low) * std::sqrt(high) : 1e-3 * high;
    if (std::abs(next - p) <= precision * p) return next;
    p = next;
  }
  return p;
}

GasState mirrored(const GasState& k) { return {k.rho, -k.v, k.p}; }

}  // namespace

RiemannFan::RiemannFan(const GasState& left, const GasState& right, double gamma)
    : left_(left), right_(right), gamma_(gamma) {
  if (!(left_.rho > 0)) left_ = {0, 0, 0};
  if (!(right_.rho > 0)) right_ = {0, 0, 0};
  const double escape = 2 / (gamma - 1) * (sound_speed(left_, gamma) + sound_speed(right_, gamma));
  vacuum_ = !(left_.rho > 0) || !(right_.rho > 0) || right_.v - left_.v >= escape;  // Toro (2009), eq. 4.82
  if (vacuum_) return;
  p_ = star_pressure(left_, right_, gamma);
  v_ = 0.5 * (left_.v + right_.v) + 0.5 * (wave(right_, p_, gamma).change - wave(left_, p_, gamma).change);
}

GasState RiemannFan::left_wave(GasState k, double s, double v_star) const {
  if (!(k.rho > 0)) return {0, 0, 0};
  const double g = gamma_, c = sound_speed(k, g);
  // Inside a fan, Toro (2009), eq. 4.56.
  const auto fan = [&] {
    const double ratio = 2 / (g + 1) + (g - 1) / ((g + 1) * c) * (k.v - s);
    return GasState{k.rho * std::pow(ratio, 2 / (g - 1)), 2 / (g + 1) * (c + (g - 1) / 2 * k.v + s),
                    k.p * std::pow(ratio, 2 * g / (g - 1))};
  };
  if (vacuum_) {
    const double edge = k.v + 2 * c / (g - 1);
    if (s <= k.v - c) return k;
    return s < edge ? fan() : GasState{0, 0, 0};
  }
  if (p_ > k.p) {  // shock; written so that a cold gas (p = 0) needs no case of its own
    const double jump = ((g + 1) * p_ + (g - 1) * k.p) / ((g - 1) * p_ + (g + 1) * k.p);
    const double mass_flux = std::sqrt(0.5 * k.rho * ((g + 1) * p_ + (g - 1) * k.p));
    return s < k.v - mass_flux / k.rho ? k : GasState{k.rho * jump, v_star, p_};
  }
  const double c_star = c * std::pow(p_ / k.p, (g - 1) / (2 * g));
  if (s <= k.v - c) return k;
  return s < v_star - c_star ? fan() : GasState{k.rho * std::pow(p_ / k.p, 1 / g), v_star, p_};
}

GasState RiemannFan::operator()(double s) const {
  if (vacuum_) {  // the two sides never meet: whichever of them is there
    const GasState l = left_wave(left_, s, 0);
    return l.rho > 0 ? l : mirrored(left_wave(mirrored(right_), -s, 0));
  }
  return s < v_ ? left_wave(left_, s, v_) : mirrored(left_wave(mirrored(right_), -s, -v_));
}

RiemannFan Riemann::fan() const {
  if (!(gamma > 1))
    no_solution(info.name, "gamma is not above 1", "p = (gamma-1) rho e would be no pressure", "give 1.4 for air");
  if ((rho_left == 0 && p_left > 0) || (rho_right == 0 && p_right > 0))
    no_solution(info.name, "a side has pressure without density", "it would be infinitely hot",
                "for a vacuum set density and pressure of that side to 0");
  return {{rho_left, v_left, p_left}, {rho_right, v_right, p_right}, gamma};
}

}  // namespace undine::exact
