#pragma once
#include <optional>

#include "undine/schemes/flow_options.hpp"

namespace undine {

/// Every choice of a run of a compressible gas, as data.
template <int N>
struct GasOptions : FlowOptions<N> {
  DensityForm density = DensityForm::grad_h;
  OneOf<terms::GradHDensities> grad_h;  ///< the sum of density form `grad_h`
  double support_over_spacing = 2.4;    ///< q in rho H^N = m q^N
  OneOf<terms::ContinuityForms> continuity;
  OneOf<terms::GasPressureForms> pressure;
  OneOf<terms::EnergyForms> energy;
  std::optional<OneOf<terms::GasViscosities>> artificial;
  ChoiceOf<terms::ViscositySwitches> viscosity_switch;
  bool limiter = false;  ///< whether artificial viscosity fades where flow shears, by `balsara`
  std::optional<OneOf<terms::Conductivities>> conductivity;
  std::optional<OneOf<terms::StressForms>> stress;  ///< of a viscous gas

  bool iterates() const { return density == DensityForm::grad_h; }
  /// Whether something follows the rate of density by continuity.
  bool takes_density_rate() const {
    return density == DensityForm::evolved || this->smoothing == SmoothingLaw::continuity;
  }
  bool switches() const { return artificial && viscosity_switch.index() != 0; }
  /// Whether the switch looks ahead, at the divergence of the acceleration.
  bool foresees() const {
    return switches() && viscosity_switch.index() == terms::ViscositySwitches::index<terms::SwitchCullenDehnen>();
  }
  bool takes_velocity_gradient() const { return switches() || stress || (artificial && limiter); }
};

}  // namespace undine
