#pragma once
#include "undine/app/gauges/centre_of_mass.hpp"
#include "undine/app/gauges/coincidence.hpp"
#include "undine/app/gauges/density.hpp"
#include "undine/app/gauges/error.hpp"
#include "undine/app/gauges/extremes.hpp"
#include "undine/app/gauges/front.hpp"
#include "undine/app/gauges/height.hpp"
#include "undine/app/gauges/leak.hpp"
#include "undine/app/gauges/mixed_layer.hpp"
#include "undine/app/gauges/probe.hpp"
#include "undine/app/gauges/profile.hpp"
#include "undine/app/gauges/shell.hpp"
#include "undine/app/gauges/wall_force.hpp"
#include "undine/app/gauges/wall_motion.hpp"

namespace undine::gauges {

/// The one list of gauge types.
template <int N>
using GaugeTypes = Catalogue<  //
    Probe<N>,                  //
    Height<N>,                 //
    WallForce<N>,              //
    Front<N>,                  //
    Extremes<N>,               //
    Leak<N>,                   //
    WallJitter<N>,             //
    Coincidence<N>,            //
    MeanDensity<N>,            //
    CentreOfMass<N>,           //
    MixedLayer<N>,             //
    Profile<N>,                //
    Shell<N>,                  //
    ErrorGauge<N>>;

}  // namespace undine::gauges
