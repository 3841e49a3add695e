#pragma once
#include "undine/integrators/euler.hpp"
#include "undine/integrators/leapfrog.hpp"
#include "undine/integrators/predictor_corrector.hpp"
#include "undine/integrators/runge_kutta.hpp"

namespace undine::integrators {

/// The one list of integrators.
using Integrators = Catalogue<      //
    Leapfrog,                       //
    PredictorCorrector,             //
    Euler,                          //
    RungeKutta<Heun>,               //
    RungeKutta<ShuOsher>,           //
    RungeKutta<Classical>,          //
    EmbeddedPair<BogackiShampine>,  //
    EmbeddedPair<DormandPrince> >;

}  // namespace undine::integrators
