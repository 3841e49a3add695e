#pragma once
#include "undine/app/watchdog/cause.hpp"

namespace undine::causes {

// What is wrong from the start.

struct BodyForceNotFinite {
  static constexpr Info info{"body_force_not_finite", "The imposed force has no value somewhere",
                             "body_force(x, t) is not finite at a particle", ""};
  static bool holds(const Evidence& e) { return !e.before.body_force_finite; }
  static std::string because(const Evidence& e) {
    return fmt::format("body_force is not a finite number at t = {:.6g} s", e.time);
  }
  static std::string remedy(const Evidence&) {
    return "look in body_force for a division by 0, or the root or logarithm of a negative number, at that time; "
           "if(condition, a, b) takes either value";
  }
};

struct UnitsOfDensity {
  static constexpr Info info{"units_of_density", "Mass and density are given in different units",
                             "m/(rho_0 spacing^N) < 0.1 or > 10; of a gas the median of sum m W/rho", ""};
  static bool holds(const Evidence& e) {
    // Gases thin and dense have the same masses, or the same spacing.
    if (e.setup.gas) return e.start.filling < 0.1 || e.start.filling > 10;
    return e.start.least_mass < 0.1 || e.start.most_mass > 10;
  }
  static std::string because(const Evidence& e) {
    if (e.setup.gas) return fmt::format("masses fill space {:.3g} times with the densities as given", e.start.filling);
    const double worst = e.start.most_mass > 10 ? e.start.most_mass : e.start.least_mass;
    return fmt::format("particles hold {:.3g} times the mass rho_0 spacing^{} that density and spacing give", worst,
                       e.setup.dimensions);
  }
  static std::string remedy(const Evidence&) {
    return "give density in kg/m^3 or with its unit (\"1 g/cm^3\"), and leave particle_mass out";
  }
};

/// A start that differs from rho_0 by more than a stiff liquid can be compressed.
struct InitialDensity {
  static constexpr Info info{"initial_density", "The fluid starts far from its density at rest",
                             "at the start rho/rho_0 < 0.8 or > 1.2; with a summed density m/(rho_0 spacing^N) too",
                             ""};
  static bool holds(const Evidence& e) {
    if (!e.setup.stiff) return false;
    if (e.setup.summed) return e.start.least_mass < 0.8 || e.start.most_mass > 1.25;
    return e.start.lowest_density < 0.8 || e.start.highest_density > 1.2;
  }
  static std::string because(const Evidence& e) {
    if (e.setup.summed)
      return fmt::format("particles hold {:.3g} to {:.3g} times the mass rho_0 spacing^{}", e.start.least_mass,
                         e.start.most_mass, e.setup.dimensions);
    return fmt::format("the fluid starts with {:.4g} to {:.4g} of rho_0", e.start.lowest_density,
                       e.start.highest_density);
  }
  static std::string remedy(const Evidence& e) {
    if (e.setup.summed) return "leave particle_mass out: it is then rho_0 spacing^N";
    return "look at pressure and surface of [[fluid]] (lengths in m, pressures in Pa) and at rho of a particle list; a "
           "larger speed of sound gives the same pressure with less compression";
  }
};

struct OverlapAtStart {
  static constexpr Info info{"overlap_at_start", "Particles lie on each other at the start",
                             "closest pair < 0.8 spacing and largest sum m W/rho > 1.2", ""};
  static bool holds(const Evidence& e) { return e.start.closest < 0.8 && e.start.most_filling > 1.2; }
  static std::string because(const Evidence& e) {
    return fmt::format("at the start two particles are {:.3g} spacings apart, and space is filled up to {:.3g} times",
                       e.start.closest, e.start.most_filling);
  }
  static std::string remedy(const Evidence&) {
    return "cut one body out of the other with a 'difference', align their edges and anchors to the spacing, and make "
           "periods whole numbers of spacings";
  }
};

struct WildParticle {
  static constexpr Info info{"wild_particle", "One particle starts with a velocity out of all proportion",
                             "largest initial speed > 20 times that of the others, and > 0.2 c_0", ""};
  static bool holds(const Evidence& e) {
    return e.start.fastest > 20 * e.start.typical_speed && e.start.fastest > 0.2 * e.setup.sound_speed &&
           e.start.fastest > 2 * std::sqrt(2 * e.setup.gravity * e.setup.depth);
  }
  static std::string because(const Evidence& e) {
    return fmt::format("a particle starts with {:.4g} m/s, 99 % of the others with at most {:.4g} m/s", e.start.fastest,
                       e.start.typical_speed);
  }
  static std::string remedy(const Evidence&) { return "look for a wrong number in the particle list or in 'velocity'"; }
};

}  // namespace undine::causes
