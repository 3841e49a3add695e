#pragma once
#include "undine/app/watchdog/cause.hpp"

namespace undine::causes {

// Steps and speeds of sound.

struct StepOverCourant {
  static constexpr Info info{"step_over_courant", "The time step is longer than sound allows",
                             "c_0 dt/h > 0.7; of a gas v_signal dt/h", "Monaghan (1992), eq. 10.5"};
  static bool holds(const Evidence& e) { return e.courant() > 0.7; }
  static std::string because(const Evidence& e) {
    if (e.setup.gas)
      return fmt::format("signals cross {:.3g} h in a step of {:.4g} s; 0.3 is usual", e.courant(), e.dt);
    return fmt::format("c dt/h = {:.3g} with c = {:.4g} m/s, dt = {:.4g} s, h = {:.4g} m; 0.4 is usual", e.courant(),
                       e.setup.sound_speed, e.dt, e.h());
  }
  static std::string remedy(const Evidence& e) {
    const double usual = e.setup.gas ? 0.3 : 0.4, good = usual * e.dt / e.courant();
    return e.setup.fixed_step
               ? fmt::format("set time.step to {:.3g} s or less, or leave it out and let time.courant choose", good)
               : fmt::format("set time.courant to {} or less", usual);
  }
};

struct StepOverViscous {
  static constexpr Info info{"step_over_viscous", "The time step is longer than viscosity allows", "nu dt/h^2 > 0.25",
                             "Morris, Fox & Zhu (1997), eq. 23"};
  static bool holds(const Evidence& e) { return e.viscous_number() > 0.25; }
  static std::string because(const Evidence& e) {
    return fmt::format("nu dt/h^2 = {:.3g} with nu = {:.4g} m^2/s, dt = {:.4g} s; 0.125 is usual", e.viscous_number(),
                       e.setup.viscosity, e.dt);
  }
  static std::string remedy(const Evidence& e) {
    const double good = 0.125 * sq(e.h()) / e.setup.viscosity;
    return fmt::format("set {} to {:.3g}{} or less; look at the unit of viscosity (Pa s)",
                       e.setup.fixed_step ? "time.step" : "time.viscous", e.setup.fixed_step ? good : 0.125,
                       e.setup.fixed_step ? " s" : "");
  }
};

struct WallFasterThanSound {
  static constexpr Info info{"wall_faster_than_sound", "A wall moves at the speed of sound or above",
                             "largest speed of wall particles > 0.3 c_0, of a liquid", ""};
  static bool holds(const Evidence& e) { return !e.setup.gas && e.before.fastest_wall > 0.3 * e.setup.sound_speed; }
  static std::string because(const Evidence& e) {
    return fmt::format("a wall moves at {:.4g} m/s, the speed of sound is {:.4g} m/s", e.before.fastest_wall,
                       e.setup.sound_speed);
  }
  static std::string remedy(const Evidence& e) {
    return fmt::format("look at displacement (m, of t in s); if it is right, set expected_speed = {:.3g}",
                       e.before.fastest_wall);
  }
};

struct UnitsOfGravity {
  static constexpr Info info{"units_of_gravity", "Gravity compresses the fluid by its own weight",
                             "g > 50 m/s^2 and sqrt(2 g depth) > 0.3 c_0, of a liquid", ""};
  static bool holds(const Evidence& e) {
    return !e.setup.gas && e.setup.gravity > 50 &&
           std::sqrt(2 * e.setup.gravity * e.setup.depth) > 0.3 * e.setup.sound_speed;
  }
  static std::string because(const Evidence& e) {
    return fmt::format(
        "gravity is {:.4g} m/s^2; over the depth of {:.4g} m it gives {:.4g} m/s, the speed of sound is "
        "{:.4g} m/s",
        e.setup.gravity, e.setup.depth, std::sqrt(2 * e.setup.gravity * e.setup.depth), e.setup.sound_speed);
  }
  static std::string remedy(const Evidence&) {
    return "give gravity in m/s^2 (9.81), lengths in m; if they are right, raise the speed of sound";
  }
};

struct SoundSpeedTooSmall {
  static constexpr Info info{"sound_speed_too_small", "The speed of sound is too small for this flow",
                             "natural speed > 0.2 c_0", "Monaghan (1994), sec. 2: ten times the largest velocity"};
  static bool holds(const Evidence& e) { return e.setup.stiff && e.natural_speed() > 0.2 * e.setup.sound_speed; }
  static std::string because(const Evidence& e) {
    return fmt::format("the speed of sound is {:.4g} m/s; gravity and initial velocities give {:.4g} m/s",
                       e.setup.sound_speed, e.natural_speed());
  }
  static std::string remedy(const Evidence& e) {
    return fmt::format("set fluid.eos.sound_speed to {:.3g} m/s or more, or leave it and expected_speed out",
                       10 * e.natural_speed());
  }
};

/// Explicit Euler feeds oscillations energy in each step: |1 + i omega dt| > 1.
struct EulerUnstable {
  static constexpr Info info{"euler_unstable", "Explicit Euler feeds energy into sound", "integrator = euler",
                             "Hairer, Lubich & Wanner (2006), I.1.2"};
  static bool holds(const Evidence& e) { return e.setup.euler && !e.left_calmly(); }
  static std::string because(const Evidence&) {
    return "the integrator is 'euler', which is stable for no oscillation";
  }
  static std::string remedy(const Evidence&) { return "set time.integrator = \"leapfrog\""; }
};

struct OneParticleTakesTheStep {
  static constexpr Info info{"one_particle_takes_the_step", "A single particle makes the step collapse",
                             "step collapsed, and one particle demands 30 times more than 99 % of the others", ""};
  static bool holds(const Evidence& e) { return e.alarm == Alarm::step_collapse && e.before.one_against_rest > 30; }
  static std::string because(const Evidence& e) {
    return fmt::format("the step is {:.3g} s for particle {} alone; 99 % of the others would allow {:.3g} times more",
                       e.dt, e.particle.id, e.before.one_against_rest);
  }
  static std::string remedy(const Evidence& e) {
    return fmt::format(
        "see what acts on it ({}); a wall's D, r_0 or exponents may be too strong, or a body force too "
        "steep there",
        e.particle.forces.empty() ? "unknown" : e.particle.forces.front().term);
  }
};

}  // namespace undine::causes
