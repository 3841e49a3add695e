#pragma once
#include "undine/app/watchdog/cause.hpp"

namespace undine::causes {

// Why particles come to lie on each other.

/// Where the gradient of W is largest farther out than the spacing, neighbours repel each other the less the nearer
/// they come.
struct KernelUnfit {
  static constexpr Info info{"kernel_unfit", "The pressure kernel pushes less, the nearer particles are",
                             "particles clump, and |grad W| of the pressure kernel is largest at r > spacing",
                             "Desbrun & Gascuel (1996); Price (2012), sec. 5.4"};
  static bool holds(const Evidence& e) { return e.clumps() && e.setup.gradient_peak > 1; }
  static std::string because(const Evidence& e) {
    return fmt::format(
        "the closest pair is {:.3g} spacings apart; the gradient of the pressure kernel is largest at "
        "{:.3g} spacings and falls to 0 towards r = 0",
        e.before.closest, e.setup.gradient_peak);
  }
  static std::string remedy(const Evidence&) {
    return "set scheme.pressure_kernel to \"wendland_c2\" (or \"spiky\"), or lessen the support";
  }
};

struct SupportTooSmall {
  static constexpr Info info{"support_too_small", "Particles have too few neighbours",
                             "median of neighbours at the start < 2, 9, 27 in 1-D, 2-D, 3-D",
                             "Monaghan (1992), sec. 4: h of 1.2 to 1.5 spacings"};
  static bool holds(const Evidence& e) {
    constexpr std::array<double, 3> least{2, 9, 27};
    return e.start.neighbours < least[static_cast<std::size_t>(e.setup.dimensions - 1)];
  }
  static std::string because(const Evidence& e) {
    return fmt::format("a particle has {:.0f} neighbours within H = {:.3g} spacings", e.start.neighbours,
                       e.setup.support / e.setup.spacing);
  }
  static std::string remedy(const Evidence&) { return "set scheme.smoothing.support to 2.6 spacings, or leave it out"; }
};

struct TensileClumping {
  static constexpr Info info{
      "tensile_clumping", "Fluid under tension clumps",
      "particles clump, and most of those that do have p < 0, or most of the fluid had at the start",
      "Swegle, Hicks & Attaway (1995); Monaghan (2000)"};
  static bool holds(const Evidence& e) { return e.clumps() && (e.before.tension > 0.5 || e.start.tension > 0.5); }
  static std::string because(const Evidence& e) {
    return fmt::format(
        "{:.0f} % of the particles that came close have a negative pressure, and {:.0f} % of all had one "
        "at the start",
        100 * e.before.tension, 100 * e.start.tension);
  }
  static std::string remedy(const Evidence&) {
    return "start at p >= 0, set scheme.wall.pulls = false, or take a pressure kernel and support that resist "
           "(\"wendland_c2\", 2.6 spacings)";
  }
};

struct MissingViscosity {
  static constexpr Info info{"missing_viscosity", "Nothing damps the motion between particles",
                             "neither viscosity nor artificial viscosity acts, and the fluid did not leave calmly",
                             "Monaghan & Gingold (1983)"};
  static bool holds(const Evidence& e) { return !e.setup.damped && !e.left_calmly(); }
  static std::string because(const Evidence&) {
    return "no viscosity acts, so that shocks let particles pass through each other";
  }
  static std::string remedy(const Evidence& e) {
    if (e.setup.gas) return "set scheme.artificial_viscosity.form = \"signal\" (alpha 1, beta 2)";
    return "set scheme.artificial_viscosity.form = \"monaghan\" (alpha 0.02; 0.1 to 1 and beta where fluid collides)";
  }
};

}  // namespace undine::causes
