#pragma once
#include "undine/app/watchdog/causes/gas.hpp"
#include "undine/app/watchdog/causes/pairs.hpp"
#include "undine/app/watchdog/causes/start.hpp"
#include "undine/app/watchdog/causes/step.hpp"
#include "undine/app/watchdog/causes/walls.hpp"

namespace undine::causes {

/// The one list of causes. The first that holds is the diagnosis: those that need one clear fact come before those that
/// explain what is left.
using Causes = Catalogue<      //
    BodyForceNotFinite,        //
    UnitsOfDensity,            //
    WildParticle,              //
    WallFasterThanSound,       //
    UnitsOfGravity,            //
    SoundSpeedTooSmall,        //
    InitialDensity,            //
    OverlapAtStart,            //
    StepOverCourant,           //
    StepOverViscous,           //
    OneParticleTakesTheStep,   //
    SharedWork,                //
    TooFewParticles,           //
    NoRoomForSupport,          //
    SupportWithoutNeighbours,  //
    WallTooThin,               //
    WallUnguarded,             //
    NothingBelow,              //
    DomainTooSmall,            //
    LeftThroughGap,            //
    EulerUnstable,             //
    KernelUnfit,               //
    SupportTooSmall,           //
    MissingViscosity,          //
    TensileClumping>;

}  // namespace undine::causes
