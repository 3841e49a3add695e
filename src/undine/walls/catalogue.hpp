#pragma once
#include "undine/walls/adami.hpp"
#include "undine/walls/combined.hpp"
#include "undine/walls/distance.hpp"
#include "undine/walls/elastic.hpp"
#include "undine/walls/ghost_free_slip.hpp"
#include "undine/walls/ghost_no_slip.hpp"
#include "undine/walls/mdbc.hpp"
#include "undine/walls/modified_density.hpp"
#include "undine/walls/none.hpp"
#include "undine/walls/repulsive.hpp"
#include "undine/walls/wall_particles.hpp"

namespace undine::walls {

/// The one list of wall treatments. A wall is a neighbour that answers with values: terms know none of this.
using Walls = Catalogue<  //
    Combined,             //
    Adami,                //
    Mdbc,                 //
    WallParticles,        //
    ModifiedDensity,      //
    Elastic,              //
    Distance,             //
    Repulsive,            //
    GhostFreeSlip,        //
    GhostNoSlip,          //
    None>;

}  // namespace undine::walls
