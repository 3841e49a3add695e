#include "undine/analysis/exact/sedov.hpp"

#include <algorithm>

namespace undine::exact {
namespace {
/// Surface of the unit sphere, circle, or pair of planes.
double unit_surface(int d) { return d == 1 ? 2 : d == 2 ? 2 * pi : 4 * pi; }
}  // namespace

SedovProfile::SedovProfile(int dimensions, double gamma) : d_(dimensions), gamma_(gamma) { integrate(); }

double SedovProfile::ln_z(double w) const { return std::log(0.5 * gamma_ * (gamma_ - 1) * sq(V(w)) * (1 - V(w))) - w; }

auto SedovProfile::rates(double w) const -> Rates {
  const double u = V(w), z = std::exp(ln_z(w)), gamma = gamma_;
  const double dz = z * (2 / u - 1 / (1 - u) - gamma * std::exp(-w));  // dz/dV
  const double numerator = u / delta() - u * u - z / gamma * (d_ * u / (1 - u) + 2);
  const double L = numerator / (u - 1 + z / (gamma * (1 - u)) + dz / gamma);
  const double ln_lambda = (1 - u) / d_;
  return {ln_lambda, gamma * L * std::exp(-w) * ln_lambda};
}

/// Runge-Kutta steps of fourth order in ln m from the shock, V = 2/(gamma+1), until V is 1/gamma but for rounding,
/// where what follows are powers of lambda; with them the energy integral
///   E = S_d/d rho_0 R^d S^2 int m lambda^2 [V^2/2 + z/(gamma (gamma-1))] dln m.
void SedovProfile::integrate() {
  constexpr double step = 0.01, deepest = -80, closest = -34;  // of ln m, and of w
  double ln_lambda = 0, w = std::log((gamma_ - 1) / (gamma_ + 1)), ln_m = 0;
  double kinetic = 0, internal = 0;
  struct Densities {
    double kinetic, internal;
  };
  const auto densities = [&](double l, double at_w, double mu) {
    return Densities{0.5 * sq(V(at_w)) * std::exp(mu + 2 * l),
                     std::exp(mu + 2 * l + ln_z(at_w)) / (gamma_ * (gamma_ - 1))};
  };
  const auto keep = [&] {
    const Rates r = rates(w);
    nodes_.push_back({ln_lambda, w, ln_m, r.w / r.ln_lambda, 1 / r.ln_lambda});
  };
  keep();
  while (ln_m > deepest && w > closest) {
    const double h = -step;
    const Rates k1 = rates(w), k2 = rates(w + 0.5 * h * k1.w), k3 = rates(w + 0.5 * h * k2.w), k4 = rates(w + h * k3.w);
    // Simpson's rule, the middle by the cubic through both ends.
    const Densities a = densities(ln_lambda, w, ln_m);
    const double l_end = ln_lambda + h / 6 * (k1.ln_lambda + 2 * k2.ln_lambda + 2 * k3.ln_lambda + k4.ln_lambda);
    const double w_end = w + h / 6 * (k1.w + 2 * k2.w + 2 * k3.w + k4.w);
    const Rates end = rates(w_end);
    const Densities b = densities(0.5 * (ln_lambda + l_end) + h / 8 * (k1.ln_lambda - end.ln_lambda),
                                  0.5 * (w + w_end) + h / 8 * (k1.w - end.w), ln_m + 0.5 * h);
    ln_lambda = l_end;
    w = w_end;
    ln_m += h;
    const Densities c = densities(ln_lambda, w, ln_m);
    kinetic += step / 6 * (a.kinetic + 4 * b.kinetic + c.kinetic);
    internal += step / 6 * (a.internal + 4 * b.internal + c.internal);
    keep();
  }
  // The rest: m lambda^2 and m lambda^2 z are powers of m there.
  const Rates r = rates(w);
  const Densities last = densities(ln_lambda, w, ln_m);
  kinetic += last.kinetic / (1 + 2 * r.ln_lambda);
  internal += last.internal / (1 + 2 * r.ln_lambda - r.w);
  alpha_ = unit_surface(d_) / d_ * sq(delta()) * (kinetic + internal);
  kinetic_share_ = kinetic / (kinetic + internal);
}

auto SedovProfile::operator()(double lambda) const -> Shape {
  const double l = std::log(std::clamp(lambda, 1e-12, 1.0));
  // Cubic between the two nodes (they descend); straight on in the logarithms beyond the last.
  const auto inner = std::ranges::lower_bound(nodes_, l, std::greater<>(), &Node::ln_lambda);
  double w, ln_m;
  if (inner == nodes_.end()) {
    const Node& n = nodes_.back();
    w = n.w + n.w_slope * (l - n.ln_lambda);
    ln_m = n.ln_m + n.ln_m_slope * (l - n.ln_lambda);
  } else if (inner == nodes_.begin()) {
    w = inner->w;
    ln_m = inner->ln_m;
  } else {
    const Node &a = *std::prev(inner), &b = *inner;
    const double length = b.ln_lambda - a.ln_lambda, s = (l - a.ln_lambda) / length;
    const auto cubic = [&](double f0, double d0, double f1, double d1) {
      return sq(1 - s) * ((1 + 2 * s) * f0 + s * length * d0) + sq(s) * ((3 - 2 * s) * f1 - (1 - s) * length * d1);
    };
    w = cubic(a.w, a.w_slope, b.w, b.w_slope);
    ln_m = cubic(a.ln_m, a.ln_m_slope, b.ln_m, b.ln_m_slope);
  }
  const double u = V(w), ln_rho = ln_m - d_ * l - std::log(1 - u), ln_e = 2 * l + ln_z(w);
  return {u, std::exp(ln_rho), std::exp(ln_rho + ln_e) / gamma_, std::exp(ln_e) / (gamma_ * (gamma_ - 1))};
}

SedovProfile Sedov::profile() const {
  const int d = whole_dimensions(dimensions);
  if (!(gamma > 1))
    no_solution(info.name, "gamma is not above 1", "p = (gamma-1) rho e would be no pressure", "give 1.4 for air");
  if (d == 3 && gamma > 7)
    no_solution(info.name, "gamma is above 7", "the blast then leaves an empty ball, which this solution has not",
                "give a gamma of at most 7");
  return {d, gamma};
}

}  // namespace undine::exact
