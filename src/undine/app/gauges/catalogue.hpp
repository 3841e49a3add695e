#pragma once
#include "undine/app/gauges/extremes.hpp"
#include "undine/app/gauges/front.hpp"
#include "undine/app/gauges/height.hpp"
#include "undine/app/gauges/probe.hpp"
#include "undine/app/gauges/wall_force.hpp"

namespace undine::gauges {

/// The one list of gauge types.
template <int N>
using GaugeTypes = Catalogue<  //
    Probe<N>,                  //
    Height<N>,                 //
    WallForce<N>,              //
    Front<N>,                  //
    Extremes<N>>;

}  // namespace undine::gauges
