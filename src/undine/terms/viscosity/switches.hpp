#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "undine/core/catalogue.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/parameter.hpp"

namespace undine::terms {
using namespace field;

// What the artificial viscosity of gases is switched by: pure functions of a particle. A switch moves alpha_v over a
// step dt, from gradients at its end; both are exact for rates that stay, so alpha keeps within its bounds for any dt.

template <int N>
constexpr double divergence(const Vec<N, Vec<N>>& L) {
  double sum = 0;
  for (int k = 0; k < N; ++k) sum += L[k][k];
  return sum;
}
/// |curl v|^2, half the square of the antisymmetric part's elements.
template <int N>
constexpr double curl_sq(const Vec<N, Vec<N>>& L) {
  double sum = 0;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < i; ++j) sum += sq(L[i][j] - L[j][i]);
  return sum;
}
/// L:L^T, the part of -d(div v)/dt that is not - div of the acceleration.
template <int N>
constexpr double stretching(const Vec<N, Vec<N>>& L) {
  double sum = 0;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) sum += L[i][j] * L[j][i];
  return sum;
}

/// f = |div v|/(|div v| + |curl v| + 1e-4 c/h). Balsara (1995), as it is used since; h = H/kappa.
template <int N>
double balsara_factor(const Vec<N, Vec<N>>& L, double c, double h) {
  const double div = std::abs(divergence(L));
  return div / (div + std::sqrt(curl_sq(L)) + 1e-4 * c / h);
}

/// A step of a switch: H is the particle's support radius, h = H/kappa.
struct SwitchStep {
  double dt, h, H;
};

/// alpha stays what the viscosity's key `alpha` says.
struct SwitchNone {
  static constexpr Info info{"none", "The same alpha for all particles at all times", "alpha_a = alpha", ""};
  using reads = Fields<alpha_v>;

  template <int N>
  double next(const auto& a, const SwitchStep&) const {
    return a.alpha_v;
  }
};

struct SwitchMorrisMonaghan {
  static constexpr Info info{
      "morris_monaghan", "Grows where flow converges, decays within a few sound crossings",
      "dalpha/dt = (alpha_min - alpha)/tau + (alpha_max - alpha) f max(-div v, 0), tau = h/(sigma c), f as `balsara`",
      "Morris & Monaghan (1997); (alpha_max - alpha): Rosswog et al. (2000); f: Balsara (1995)"};
  using reads = Fields<alpha_v, strain, c>;

  double alpha_min = 0.1, alpha_max = 1, sigma = 0.1;
  static constexpr auto parameters() {
    using P = Parameter<SwitchMorrisMonaghan>;
    return std::array{P{"alpha_min", &SwitchMorrisMonaghan::alpha_min, "1", "alpha far from shocks", 0},
                      P{"alpha_max", &SwitchMorrisMonaghan::alpha_max, "1", "alpha in strong shocks", 0},
                      P{"sigma", &SwitchMorrisMonaghan::sigma, "1", "speed of the decay", 1e-6}};
  }

  template <int N>
  double next(const auto& a, const SwitchStep& step) const {
    const double decay = sigma * a.c / step.h;
    const double source = balsara_factor<N>(a.strain, a.c, step.h) * std::max(-divergence<N>(a.strain), 0.0);
    const double rate = decay + source;
    const double goal = rate > 0 ? (decay * alpha_min + source * alpha_max) / rate : alpha_min;
    return goal + (a.alpha_v - goal) * std::exp(-rate * step.dt);
  }
};

struct SwitchCullenDehnen {
  static constexpr Info info{
      "cullen_dehnen", "Jumps up ahead of shocks, where convergence grows; none in steady compression and in shear",
      "A = xi max(-d(div v)/dt, 0); alpha = alpha_loc = alpha_max H^2 A/(v_sig^2 + H^2 A) where that is larger, else "
      "dalpha/dt = (alpha_loc - alpha) 2 l v_sig/H; xi = (div v)^2/((div v)^2 + |curl v|^2), d(div v)/dt = div acc - "
      "L:L^T",
      "Cullen & Dehnen (2010), without their limiter; xi: Balsara's kind, as in Price et al. (2018)"};
  using reads = Fields<alpha_v, strain, div_acc, v_signal, c>;

  double alpha_min = 0, alpha_max = 2, l = 0.05;
  static constexpr auto parameters() {
    using P = Parameter<SwitchCullenDehnen>;
    return std::array{P{"alpha_min", &SwitchCullenDehnen::alpha_min, "1", "alpha far from shocks", 0},
                      P{"alpha_max", &SwitchCullenDehnen::alpha_max, "1", "alpha in strong shocks", 0},
                      P{"decay", &SwitchCullenDehnen::l, "1", "l, speed of the decay", 1e-6}};
  }

  /// The alpha that the flow asks for.
  template <int N>
  double wanted(const auto& a, const SwitchStep& step) const {
    const double div_sq = sq(divergence<N>(a.strain));
    const double xi = div_sq / (div_sq + curl_sq<N>(a.strain) + sq(1e-4 * a.c / step.h));
    const double growth = xi * std::max(stretching<N>(a.strain) - a.div_acc, 0.0);
    const double shock = sq(step.H) * growth;
    const double signal_sq = sq(a.v_signal);
    return shock > 0 ? std::max(alpha_min, alpha_max * shock / (signal_sq + shock)) : alpha_min;
  }

  template <int N>
  double next(const auto& a, const SwitchStep& step) const {
    const double goal = wanted<N>(a, step);
    if (goal >= a.alpha_v) return goal;
    return goal + (a.alpha_v - goal) * std::exp(-2 * l * a.v_signal / step.H * step.dt);
  }
};

}  // namespace undine::terms
