#pragma once
#include <array>
#include <string_view>

namespace undine {

/// The energy accounts of a run, in J. State energies are functions of the particles; the others add up over time what
/// each term took out of (or, negative, put into) their sum. What is left is the residual: the error of time
/// integration, and whatever was not booked.
struct Energies {
  double kinetic = 0;
  double potential = 0;
  double elastic = 0;

  struct Ledger {
    double viscous = 0;     ///< laminar viscosity between fluid particles
    double artificial = 0;  ///< artificial viscosity between fluid particles
    double diffusion = 0;   ///< density diffusion
    double exchange = 0;    ///< pressure work not matched by compression: zero for matching pressure and density forms
    double walls = 0;       ///< given to walls of any kind, and what left the domain took along
    double xsph = 0;        ///< moved against gravity, or taken from the velocities, by XSPH
    double body = 0;        ///< given to imposed fields (body forces other than uniform gravity)

    double sum() const { return viscous + artificial + diffusion + exchange + walls + xsph + body; }
  } ledger;

  double strain_dissipated = 0;  ///< integral of 2 mu D:D over the fluid and time, J; beside the sum, for comparison
  double strain_power = 0;       ///< integral of 2 mu D:D over the fluid now, W

  double total() const { return kinetic + potential + elastic + ledger.sum(); }
};

}  // namespace undine
