#pragma once
#include "undine/integrators/euler.hpp"
#include "undine/integrators/leapfrog.hpp"
#include "undine/integrators/predictor_corrector.hpp"

namespace undine::integrators {

/// The one list of integrators.
using Integrators = Catalogue<  //
    Leapfrog,                   //
    PredictorCorrector,         //
    Euler>;

}  // namespace undine::integrators
