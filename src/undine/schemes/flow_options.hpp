#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "undine/backend/backend.hpp"
#include "undine/engine/neighbours.hpp"
#include "undine/engine/pair.hpp"
#include "undine/engine/smoothing.hpp"
#include "undine/kernels/kernel.hpp"
#include "undine/materials/catalogue.hpp"
#include "undine/schemes/wall_motion.hpp"
#include "undine/terms/catalogue.hpp"
#include "undine/terms/density/filters.hpp"
#include "undine/walls/catalogue.hpp"
#include "undine/walls/mirrors.hpp"

namespace undine {

/// Where a particle ends that set out from `from` to `to` with velocity v, past elastic walls.
template <int N>
struct Bounce {
  Vec<N> x, v;
};
template <int N>
using Reflector = std::function<Bounce<N>(const Vec<N>& from, const Vec<N>& to, const Vec<N>& v)>;

/// Imposed acceleration at (x, t), m/s^2.
template <int N>
using BodyForce = std::function<Vec<N>(const Vec<N>& x, double t)>;

/// How the support radius H of a particle goes on from the start.
enum class SmoothingLaw {
  constant,       ///< as at the start
  density,        ///< H = H_0 (rho_0/rho)^(1/N), Niedoba (2012), eq. 2.67
  continuity,     ///< dH/dt = -H/(N rho) drho/dt, Niedoba (2012), eq. 2.68
  number_density  ///< rho H^N = m q^N, solved together with the density that is summed with H
};

/// Where the density of fluid particles comes from.
enum class DensityForm {
  evolved,     ///< integrated from a continuity form
  summation,   ///< summed over the neighbours
  normalised,  ///< summed, divided by the Shepard sum over the same neighbours
  grad_h       ///< summed with each particle's own H, which follows it
};

/// The continuity form by which a density changes: a summed one as its derivative says, whichever form the case names.
inline OneOf<terms::ContinuityForms> rate_form(DensityForm density, OneOf<terms::ContinuityForms> named) {
  if (density != DensityForm::evolved) named.choose(terms::ContinuityForms::index<terms::Continuity>());
  return named;
}

/// The choices of a run that every scheme has, as data.
template <int N>
struct FlowOptions {
  std::array<KernelChoice, kernel_roles> kernels;
  Support support;  ///< `uniform` is the largest H at the start
  SmoothingLaw smoothing = SmoothingLaw::constant;
  bool own_supports = false;  ///< whether particles have an H of their own even where it is constant
  bool supports_vary() const { return own_supports || smoothing != SmoothingLaw::constant; }
  Support support_in_use() const {
    Support used = support;
    used.per_particle = supports_vary();
    return used;
  }

  std::optional<ChoiceOf<terms::DensityFilters>> density_filter;  ///< of a density that is carried by continuity

  walls::WallDensity wall_density = walls::WallDensity::none;
  bool wall_pulls =
      false;  ///< whether what walls answer may fall below the state at rest, and pull on fluid that leaves
  Reflector<N> reflector;  ///< empty: no elastic walls
  WallPlan<N> walls;
  std::optional<terms::Repulsion> repulsion;  ///< of wall particles, which then do nothing else
  std::function<Vec<N>(const Vec<N>& x)>
      pushed_out;  ///< where walls want a particle at x to be; empty: they do not push
  std::shared_ptr<const walls::Mirrors<N>> mirrors;  ///< of ghosts: needed by `copied` wall density, and only there
  bool ghost_hydrostatic = true;                     ///< p_g = p + rho g.(x_g - x), instead of p_g = p
  double mirrored_support = 0;                       ///< the largest H that the mirrors serve, m

  std::vector<materials::Material> materials;
  Vec<N> gravity{};
  BodyForce<N> body_force;  ///< empty: gravity alone

  bool lets_escape = false;  ///< whether fluid that leaves the domain is taken out, instead of ending the run
  FieldSet kept;             ///< of the set-up, besides those that the scheme needs
  Backend backend;
  typename Neighbours<N>::Options neighbours;
};

/// Factors of the step limits; a fixed step when `fixed` > 0.
struct StepLimits {
  double fixed = 0;
  double courant = 0.4;    ///< of h / (c + mu), Monaghan (1992), eq. 10.5
  double force = 0.25;     ///< of sqrt(h / |acc|)
  double viscous = 0.125;  ///< of h^2 rho / mu, Morris et al. (1997), eq. 23
  double largest = 1e300;
};

struct Step {
  double dt;
  const char* limiter;  ///< "fixed", "courant", "force", "viscous", "largest"
};

/// The largest rates of any particle, by which its limits act: of signals, 1/s; the square of acceleration over h,
/// 1/s^4; of viscosity over h^2, 1/s, 0 without one.
struct StepRates {
  double signal = 0, force_sq = 0, viscous = 0;
};

/// The smallest of what the limits allow.
inline Step shortest_step(const StepLimits& limits, const StepRates& rates) {
  Step step{limits.largest, "largest"};
  const auto limit = [&](double dt, const char* name) {
    if (dt < step.dt) step = {dt, name};
  };
  limit(limits.courant / rates.signal, "courant");
  limit(limits.force / std::sqrt(std::sqrt(rates.force_sq)), "force");
  if (rates.viscous > 0) limit(limits.viscous / rates.viscous, "viscous");
  return step;
}

/// What the viscous limit allows a material at rest, s; h in m. Infinite without viscosity.
inline double viscous_step(const StepLimits& limits, double h, const materials::Material& at_rest) {
  return at_rest.mu > 0 ? limits.viscous * sq(h) * at_rest.rho_0 / at_rest.mu : std::numeric_limits<double>::infinity();
}

}  // namespace undine
