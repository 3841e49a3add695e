#pragma once
#include "undine/engine/pair_sweep.hpp"
#include "undine/terms/catalogue.hpp"

namespace undine {

/// The sweeps over pairs that a gas needs beside those of a liquid. Their loops are compiled in gas_sweeps_Nd.cpp, once
/// for each instruction set; each pair has its own H in them.
template <int N>
struct GasSweeps {
  static constexpr auto pr = KernelRole::pressure;

  /// By the mean of both gradients, where the case averages those.
  struct Continuity : OneOf<terms::ContinuityForms> {
    static constexpr bool needs_both_supports = true;
  };

  using Density = PairSweep<N, Use<OneOf<terms::GradHDensities>>>;
  using Rate = PairSweep<N, Use<Continuity, pr>>;
  using Force = PairSweep<N,                                        //
                          Use<OneOf<terms::GasPressureForms>, pr>,  //
                          Use<OneOf<terms::EnergyForms>, pr>,       //
                          Use<Continuity, pr>,                      //
                          Use<OneOf<terms::GasViscosities>, pr>,    //
                          Use<OneOf<terms::Conductivities>, pr>,    //
                          Use<OneOf<terms::StressForms>, pr>,       //
                          Use<terms::SignalSpeed, pr>>;
  /// Places of the uses in Force.
  enum InForce : std::size_t { pressure, energy, continuity, artificial, conductivity, stress, signal };

  using Foresight = PairSweep<N, Use<terms::AccelerationDivergence>>;
};

}  // namespace undine
