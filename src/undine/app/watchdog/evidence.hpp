#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "undine/geometry/bounds.hpp"

namespace undine {

/// What the watchdog stops a run for.
enum class Alarm { not_finite, outside, step_collapse, density, coincidence, residual, energy, support, isolated };
inline constexpr std::array<std::string_view, 9> alarm_names{
    "not_finite", "outside", "step_collapse", "density", "coincidence", "residual", "energy", "support", "isolated"};

/// A part of an acceleration, by the term and the group that it comes from.
struct ForceShare {
  std::string term;  ///< such as "pressure (wall)"
  double size = 0;   ///< m/s^2
};

/// What is known of a run that went bad, as numbers alone: what the rules of causes/ judge. Of 1-D and 2-D runs the
/// further components are 0.
struct Evidence {
  Alarm alarm = Alarm::not_finite;
  double time = 0;  ///< s, of the alarm
  std::int64_t step = 0;
  double dt = 0;  ///< s, of the step that led to it

  /// The particle that went bad first, in the last state in which all was finite.
  struct Particle {
    std::int64_t id = -1;  ///< -1: the alarm is of all particles together
    Vec3 x{}, v{}, acc{};
    double rho = 1000, rho_0 = 1000;  ///< kg/m^3
    double p = 0;                     ///< Pa
    double c = 1;                     ///< m/s
    double e = 0, support = 0;        ///< J/kg, m; of a gas
    double depth =
        std::numeric_limits<double>::infinity();  ///< m, before the surface of the nearest wall; < 0: behind it
    std::vector<ForceShare> forces;               ///< the largest first
  } particle;

  /// What the case says.
  struct Case {
    double spacing = 1, support = 2.6, kappa = 2;  ///< m, m, -
    double sound_speed = 1;                        ///< m/s, the smallest c_0 of the fluids; of a gas its largest c
    double gravity = 0;                            ///< m/s^2
    double depth = 0;                              ///< m, height of the fluid against gravity at the start
    double gradient_peak = 0.65;  ///< r/spacing at which the gradient of the pressure kernel is largest
    double viscosity = 0;         ///< m^2/s, the largest of the fluids that acts
    bool damped = true;           ///< whether any viscosity acts
    bool summed = false;          ///< density by summation
    bool stiff = true;            ///< whether all densities must stay near rho_0
    bool gas = false;             ///< whether particles have an internal energy
    bool follows = false;         ///< whether H follows the density of a gas
    bool shares_work = false;     ///< whether the work of a gas's pressure is halved between the particles of a pair
    double least_company = 0;     ///< q^N/(H^N W(0)): what `company` must be for an H that belongs to a density
    bool removes = false;         ///< whether what leaves the domain is taken out
    bool ghosts = false;          ///< whether walls mirror the fluid
    double room = std::numeric_limits<double>::infinity();  ///< m, the largest H that ghosts and periods serve
    bool fixed_step = false;
    bool euler = false;  ///< explicit Euler
    int dimensions = 2;
    bool walls = false;      ///< whether there are any
    bool guarded = false;    ///< whether all surfaces reflect what would pass them
    int layers_missing = 0;  ///< of the thinnest wall of particles, to what H spans
  } setup;

  /// The state at the start of the run.
  struct Start {
    double closest = 1;                              ///< spacings
    double filling = 1, most_filling = 1;            ///< sum_b m_b W_ab / rho_a: median and largest
    double lowest_density = 1, highest_density = 1;  ///< rho/rho_0
    double tension = 0;                              ///< share of particles with p < 0
    double least_mass = 1, most_mass = 1;            ///< m/(rho_0 spacing^N)
    double fastest = 0, typical_speed = 0;           ///< m/s: largest, and that of the 99 % slowest
    double sound = 0;                                ///< m/s, the largest c of a gas
    double neighbours = 20;                          ///< median number within H
  } start;

  /// The last state in which all was finite.
  struct Before {
    double closest = 1;           ///< spacings
    double clumped = 0;           ///< share of particles with a neighbour nearer than 0.3 spacings
    double tension = 0;           ///< share of those with p < 0
    double fastest = 0;           ///< m/s, of the fluid
    double fastest_wall = 0;      ///< m/s
    double behind = 0;            ///< m, how far the deepest fluid is behind a wall's surface
    double isolated = 0;          ///< share of particles without a neighbour within H
    double courant = 0;           ///< largest v_signal dt/h of a gas
    double one_against_rest = 1;  ///< largest demand on the step over that of the 99 % easiest
    bool body_force_finite = true;
    double body_force = 0;  ///< m/s^2, largest
  } before;

  /// The state that the alarm was for: where the particle left the domain, if it did.
  struct Exit {
    bool left = false;
    bool downwards = false, upwards = false;  ///< through the face that gravity points to, or the one above
    double speed = 0;                         ///< m/s
    double widest = 0;                        ///< m, the largest H then
    /// What the widest support could sum at most: the mass of all fluid over the particle's own, or their number.
    double company = std::numeric_limits<double>::infinity();
  } exit;

  double h() const { return setup.support / setup.kappa; }
  /// c dt/h; of a gas by the speed of signals, where it is largest.
  double courant() const { return setup.gas ? before.courant : setup.sound_speed * dt / h(); }
  /// nu dt/h^2.
  double viscous_number() const { return setup.viscosity * dt / sq(h()); }
  /// What gravity, the initial velocities and the expansion of a gas can give, m/s.
  double natural_speed() const;
  /// How far fluid is behind the surface of a wall, m.
  double behind_walls() const { return std::max(before.behind, -particle.depth); }
  bool clumps() const { return alarm == Alarm::coincidence || before.closest < 0.1 || before.clumped > 0.05; }
  /// Whether it left or passed a wall at no more than the speeds that the case has by itself.
  bool left_calmly() const { return exit.left && exit.speed < 2.5 * natural_speed(); }
};

}  // namespace undine
