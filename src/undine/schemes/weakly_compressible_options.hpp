#pragma once
#include <optional>

#include "undine/schemes/flow_options.hpp"

namespace undine {

/// What XSPH corrects: the velocity that moves particles (Saalfeld 2012, eq. 50), or the velocity itself (his table 2).
enum class XsphTarget { position, velocity };

/// Every choice of a weakly compressible run, as data.
template <int N>
struct WeaklyCompressibleOptions : FlowOptions<N> {
  DensityForm density = DensityForm::evolved;
  OneOf<terms::ContinuityForms> continuity;
  OneOf<terms::PressureForms> pressure;
  std::optional<OneOf<terms::ViscosityForms>> viscosity;
  std::optional<OneOf<terms::ArtificialViscosities>> artificial;
  std::optional<OneOf<terms::VelocityCorrections>> xsph;
  XsphTarget xsph_target = XsphTarget::position;
  std::optional<OneOf<terms::DiffusionForms>> diffusion;

  bool wall_friction = true;        ///< whether viscosities act between fluid and walls
  bool wall_no_slip = false;        ///< whether viscosities hold the fluid at the walls' surface, not only drag on it
  bool strain_dissipation = false;  ///< also measure 2 mu D:D from the velocity gradient, at the cost of a sweep
};

}  // namespace undine
