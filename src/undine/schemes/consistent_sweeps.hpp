#pragma once
#include "undine/engine/pair_sweep.hpp"
#include "undine/terms/catalogue.hpp"
#include "undine/terms/gradient/corrected.hpp"
#include "undine/terms/velocity/shifting.hpp"

namespace undine {

/// The sweeps of runs that correct gradients or shift particles. They stand beside those of WeaklyCompressibleSweeps,
/// so that the loops of other runs carry none of it. Compiled in consistent_sweeps_Nd.cpp.
template <int N>
struct ConsistentSweeps {
  static constexpr auto d = KernelRole::density;
  static constexpr auto pr = KernelRole::pressure;
  static constexpr auto vi = KernelRole::viscosity;
  static constexpr auto rare = Presence::rare;

  using Force = PairSweep<N,                                                                  //
                          Use<terms::ApproachSpeed, d, rare>,                                 //
                          Use<terms::Corrected<OneOf<terms::PressureForms>>, pr, rare>,       //
                          Use<terms::Corrected<OneOf<terms::ContinuityForms>>, pr, rare>,     //
                          Use<OneOf<terms::ArtificialViscosities>, vi, rare>,                 //
                          Use<OneOf<terms::DiffusionForms>, d, rare>,                         //
                          Use<terms::Corrected<terms::ShiftedTransport>, d, rare>,            //
                          Use<terms::MeanCorrected<OneOf<terms::ViscosityForms>>, vi, rare>,  //
                          Use<terms::Corrected<OneOf<terms::NoSlipForms>>, vi, rare>>;
  /// Places of the uses in Force: the first seven as in WeaklyCompressibleSweeps::Force, transport in place of XSPH.
  enum InForce : std::size_t { approach, pressure, continuity, artificial, diffusion, transport, viscosity, friction };

  using Continuity = PairSweep<N, Use<terms::Corrected<OneOf<terms::ContinuityForms>>, pr, rare>>;
  using Shift = PairSweep<N, Use<OneOf<terms::Shiftings>, d, rare>>;
};

}  // namespace undine
