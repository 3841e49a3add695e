#pragma once
#include <string_view>

#include "undine/core/catalogue.hpp"

namespace undine::presets {

// A preset is what the keys of [scheme] default to. Each key can be set on its own.

/// Chosen by the runs in docs/decisions.md, "recommended scheme".
struct Recommended {
  static constexpr Info info{
      "recommended", "What we find best for free-surface water",
      "Wendland C2, H = 2.6 dp, continuity, symmetric pressure, Tait by sound speed, fourtakas diffusion, "
      "alpha = 0.02, no tension under gravity, pairs kept apart, Adami walls that never pull, guarded by reflection",
      "docs/decisions.md"};
  static constexpr std::string_view kernel = "wendland_c2", density = "continuity", pressure = "symmetric",
                                    viscosity = "none", artificial = "monaghan", diffusion = "fourtakas", xsph = "none",
                                    xsph_target = "position", eos = "tait_sound_speed", wall = "adami",
                                    wall_reference = "auto", integrator = "leapfrog", gradients = "plain",
                                    shifting = "none", slip = "wall_velocity";
  static constexpr double support_over_spacing = 2.6, alpha = 0.02, epsilon = 0.5, fixed_step = 0;
  static constexpr double separation = 10, reach = 0.5;  ///< of (expected speed)^2, of the spacing
  static constexpr bool tension = false;                 ///< of liquids under gravity; others bear it
  static constexpr bool wall_pulls = false, guard = true;
  static constexpr int wall_layers = 0;  ///< 0: as many as the support needs
};

struct Saalfeld {
  static constexpr Info info{
      "saalfeld", "The set-up of Saalfeld's thesis, exactly",
      "Wendland C2, H = 2.25 dp, volume-weighted continuity, symmetric pressure, Tait with p_ref 101300 Pa, laminar "
      "viscosity, XSPH 0.1, dt = 1 ms, combined walls of one sheet with rho_wref = rho_0",
      "Saalfeld (2012), table 2 and ch. 7"};
  static constexpr std::string_view kernel = "wendland_c2", density = "continuity_volume", pressure = "symmetric",
                                    viscosity = "laminar", artificial = "none", diffusion = "none", xsph = "xsph",
                                    xsph_target = "velocity", eos = "tait", wall = "combined", wall_reference = "rho_0",
                                    integrator = "leapfrog", gradients = "plain", shifting = "none",
                                    slip = "wall_velocity";
  static constexpr double support_over_spacing = 2.25, alpha = 0.02, epsilon = 0.1, fixed_step = 1e-3;
  static constexpr double separation = 0, reach = 0.5;
  static constexpr bool tension = true;
  static constexpr bool wall_pulls = true, guard = false;
  static constexpr int wall_layers = 1;
};

/// For gases, by validation/niedoba.
struct Gas {
  static constexpr Info info{"gas", "What we find best for gases with shocks",
                             "Quintic spline, rho and H from each other (H = 3.6 dp), variational grad-h forces, "
                             "viscosity by the signal speed "
                             "switched as Cullen and Dehnen do, conductivity by the speed of approach, ideal gas",
                             "validation/niedoba"};
  static constexpr bool is_gas = true;
  static constexpr std::string_view kernel = "quintic_spline", density = "grad_h_mass", law = "number_density",
                                    mean = "arithmetic", pressure = "grad_h_mass", artificial = "signal",
                                    limiter = "none", viscosity_switch = "cullen_dehnen", conductivity = "velocity",
                                    eos = "ideal_gas", wall = "none", wall_reference = "auto", integrator = "leapfrog";
  static constexpr double support_over_spacing = 3.6, alpha = 1, beta = 2, fixed_step = 0;
  static constexpr bool wall_pulls = true, guard = false;
  static constexpr int wall_layers = 0;
};

struct Niedoba {
  static constexpr Info info{
      "niedoba", "The gas of Niedoba's thesis",
      "Gaussian, density by continuity, H by the rate of density (H = 3.6 dp), symmetric pressure "
      "and work, Monaghan's viscosity with alpha = beta = 1, ghosts without friction, ideal gas",
      "Niedoba (2012), ch. 3"};
  static constexpr bool is_gas = true;
  static constexpr std::string_view kernel = "gaussian", density = "continuity", law = "density_rate",
                                    mean = "arithmetic", pressure = "symmetric", artificial = "monaghan",
                                    limiter = "none", viscosity_switch = "none", conductivity = "none",
                                    eos = "ideal_gas", wall = "ghost_free_slip", wall_reference = "auto",
                                    integrator = "leapfrog";
  static constexpr double support_over_spacing = 3.6, alpha = 1, beta = 1, fixed_step = 0;
  static constexpr bool wall_pulls = true, guard = false;
  static constexpr int wall_layers = 1;
};

/// Chosen by the runs in docs/viscous.md.
struct Confined {
  static constexpr Info info{
      "confined", "What we find best for viscous flow without a free surface",
      "Wendland C2, H = 3 dp, volume-weighted continuity, pressure differences, Morris viscosity, antuono diffusion, "
      "all with corrected gradients; Fickian shifting; linear equation of state; Adami walls that pull, without slip",
      "docs/viscous.md"};
  static constexpr std::string_view kernel = "wendland_c2", density = "continuity_volume", pressure = "difference",
                                    viscosity = "morris", artificial = "none", diffusion = "antuono", xsph = "none",
                                    xsph_target = "position", eos = "linear", wall = "adami", wall_reference = "auto",
                                    integrator = "leapfrog", gradients = "corrected", shifting = "fickian",
                                    slip = "no_slip";
  static constexpr double support_over_spacing = 3, alpha = 0.02, epsilon = 0.5, fixed_step = 0;
  static constexpr double separation = 0, reach = 0.5;
  static constexpr bool tension = true;
  static constexpr bool wall_pulls = true, guard = true;
  static constexpr int wall_layers = 0;
};

/// The one list of schemes.
using Presets = Catalogue<Recommended, Saalfeld, Confined, Gas, Niedoba>;

}  // namespace undine::presets
