#pragma once
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "undine/app/parameters.hpp"
#include "undine/core/parameter.hpp"
#include "undine/io/case/table.hpp"
#include "undine/schemes/gas_options.hpp"
#include "undine/schemes/weakly_compressible_options.hpp"

namespace undine {

/// What [scheme], [time] and gravity say, apart from particles.
struct SchemeChoice {
  int preset = 0;       ///< index in presets::Presets
  bool is_gas = false;  ///< whose particles have an internal energy
  std::string integrator;
  StepLimits limits;
  double end = 0;                                              ///< s
  double tolerance = std::numeric_limits<double>::infinity();  ///< of integrators that know their error
  bool reflects = false;                                       ///< elastic surfaces are wanted
  bool wall_particles = false;
  walls::WallForce wall_force = walls::WallForce::none;
  std::optional<walls::Slip> ghosts;  ///< of walls that mirror the fluid
  std::string wall_reference;         ///< "auto", "rho_0" or empty: `wall_reference_density`
  double wall_reference_density = 0;  ///< kg/m^3
  double restitution = 1;
  double alpha_at_start = 0;         ///< of the artificial viscosity of a gas
  double support_growth = 1;         ///< how far H may grow where walls mirror the fluid
  double separation = 0, reach = 0;  ///< defaults of what keeps pairs apart: of (expected speed)^2, of the spacing
  int wall_layers = 0;               ///< 0: as many as the support needs
  std::vector<double> gravity;       ///< m/s^2, one per dimension
};

/// The options of one of the schemes.
template <int N>
using SchemeOptions = std::variant<WeaklyCompressibleOptions<N>, GasOptions<N>>;

/// Reads the scheme into options; `spacing` in m. Materials, reflector and body force are left to the particles'
/// set-up.
template <int N>
SchemeChoice read_scheme(const Table& root, double spacing, SchemeOptions<N>& options);

/// The terms of a scheme in one line, for people.
template <int N>
std::string describe_terms(const SchemeOptions<N>& options);

/// A material from a fluid's table: density, viscosity and [fluid.eos]. `expected_speed` (m/s) gives the default speed
/// of sound, ten times as large; warnings are appended where the case's own is smaller.
materials::Material read_material(const Table& table, const SchemeChoice& choice, double expected_speed,
                                  std::vector<std::string>& warnings);

}  // namespace undine
