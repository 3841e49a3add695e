#pragma once
#include "undine/engine/pair_sweep.hpp"
#include "undine/terms/catalogue.hpp"

namespace undine {

/// The sweeps over pairs that a weakly compressible liquid needs. Their loops are compiled in
/// weakly_compressible_sweeps_Nd.cpp, once for each instruction set.
template <int N>
struct WeaklyCompressibleSweeps {
  static constexpr auto d = KernelRole::density;
  static constexpr auto pr = KernelRole::pressure;
  static constexpr auto vi = KernelRole::viscosity;
  static constexpr auto always = Presence::always;

  // The pair's relative velocity along its distance, which several terms need, is known from the first one on.
  using Force = PairSweep<N,                                               //
                          Use<terms::ApproachSpeed, d, always>,            //
                          Use<OneOf<terms::PressureForms>, pr, always>,    //
                          Use<OneOf<terms::ContinuityForms>, pr, always>,  //
                          Use<OneOf<terms::ArtificialViscosities>, vi>,    //
                          Use<OneOf<terms::DiffusionForms>, d>,            //
                          Use<OneOf<terms::VelocityCorrections>, d>,       //
                          Use<OneOf<terms::ViscosityForms>, vi, Presence::rare>>;
  /// Places of the uses in Force.
  enum InForce : std::size_t { approach, pressure, continuity, artificial, diffusion, xsph, viscosity };

  using Continuity = PairSweep<N, Use<OneOf<terms::ContinuityForms>, pr>>;
  using Summation = PairSweep<N, Use<terms::Summation, d>>;
  using Shepard = PairSweep<N, Use<terms::ShepardSum, d>>;
  using WallPressure = PairSweep<N, Use<terms::WallExtrapolation, d>>;
  using WallAnswer = PairSweep<N, Use<terms::WallSlip, d>, Use<terms::WallMoment, d>>;
  /// What walls do to fluid, and fluid to walls, apart from pressure and the friction that is in Force.
  using WallPush = PairSweep<N, Use<terms::Repulsion, d>, Use<OneOf<terms::NoSlipForms>, vi>>;
  using Gradient = PairSweep<N, Use<terms::DensityGradient, d>>;
  using Strain = PairSweep<N, Use<terms::VelocityGradient, d>>;
  using WallForce = PairSweep<N, Use<OneOf<terms::PressureForms>, pr>, Use<OneOf<terms::ViscosityForms>, vi>,
                              Use<OneOf<terms::ArtificialViscosities>, vi>>;
};

}  // namespace undine
