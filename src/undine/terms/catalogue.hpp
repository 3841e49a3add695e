#pragma once
#include "undine/core/one_of.hpp"
#include "undine/terms/density/continuity.hpp"
#include "undine/terms/density/grad_h.hpp"
#include "undine/terms/density/summation.hpp"
#include "undine/terms/diffusion/antuono.hpp"
#include "undine/terms/diffusion/fourtakas.hpp"
#include "undine/terms/diffusion/molteni.hpp"
#include "undine/terms/energy/conductivity.hpp"
#include "undine/terms/energy/grad_h.hpp"
#include "undine/terms/energy/work.hpp"
#include "undine/terms/pressure/grad_h.hpp"
#include "undine/terms/pressure/mueller.hpp"
#include "undine/terms/pressure/plain.hpp"
#include "undine/terms/pressure/sum.hpp"
#include "undine/terms/pressure/symmetric.hpp"
#include "undine/terms/time_step/approach.hpp"
#include "undine/terms/time_step/signal.hpp"
#include "undine/terms/velocity/acceleration.hpp"
#include "undine/terms/velocity/strain.hpp"
#include "undine/terms/velocity/xsph.hpp"
#include "undine/terms/viscosity/gas.hpp"
#include "undine/terms/viscosity/laminar.hpp"
#include "undine/terms/viscosity/monaghan.hpp"
#include "undine/terms/viscosity/mueller.hpp"
#include "undine/terms/viscosity/stress.hpp"
#include "undine/terms/viscosity/switches.hpp"
#include "undine/terms/wall/extrapolation.hpp"
#include "undine/terms/wall/no_slip.hpp"
#include "undine/terms/wall/repulsion.hpp"

namespace undine::terms {

// The lists of terms, one line per entry; names in case files, help, docs and tests follow from them.

using PressureForms = Catalogue<  //
    PressureSymmetric,            //
    PressureSum,                  //
    PressureMueller,              //
    PressurePlain,                //
    PressureDifference>;

using ContinuityForms = Catalogue<  //
    Continuity,                     //
    ContinuityVolume>;

using ViscosityForms = Catalogue<  //
    ViscosityMorris,               //
    ViscosityLaminar,              //
    ViscosityMueller>;

using DiffusionForms = Catalogue<  //
    DiffusionFourtakas,            //
    DiffusionMolteni,              //
    DiffusionAntuono>;

using ArtificialViscosities = Catalogue<ViscosityMonaghan>;
using VelocityCorrections = Catalogue<Xsph>;
using Sums = Catalogue<Summation, ShepardSum>;
using Measures = Catalogue<DensityGradient, VelocityGradient, ApproachSpeed, WallExtrapolation, WallSlip, WallMoment,
                           SignalSpeed, AccelerationDivergence>;
using WallForces = Catalogue<Repulsion>;

/// The viscosities as no-slip walls exert them, in the order of ViscosityForms.
using NoSlipForms = Catalogue<  //
    NoSlip<ViscosityMorris>,    //
    NoSlip<ViscosityLaminar>,   //
    NoSlip<ViscosityMueller>>;

// Gases. Terms with `needs_both_supports` take grad W with H_a and with H_b; sums with `takes_target_support` take H_a.

/// Density and support radius by each other.
using GradHDensities = Catalogue<  //
    DensityGradH,                  //
    DensityGradHMass>;

using GasPressureForms = Catalogue<  //
    PressureGradH,                   //
    PressureGradHMass,               //
    PressureSymmetric,               //
    PressureSum>;

/// Work of pressure; the first four are for the pressure form of the same name.
using EnergyForms = Catalogue<  //
    EnergyGradH,                //
    EnergyGradHMass,            //
    EnergySymmetric,            //
    EnergySum,                  //
    EnergyOwn,                  //
    EnergyOwnVolume>;

using GasViscosities = Catalogue<  //
    GasViscositySignal,            //
    GasViscosityMonaghan>;

using ViscositySwitches = Catalogue<  //
    SwitchNone,                       //
    SwitchMorrisMonaghan,             //
    SwitchCullenDehnen>;

using StressForms = Catalogue<  //
    ViscousStressSum,           //
    ViscousStressSymmetric>;

using Conductivities = Catalogue<  //
    ConductivityVelocity,          //
    ConductivityPressure>;

}  // namespace undine::terms
