#pragma once
#include <variant>

#include "undine/analysis/exact/cavity.hpp"
#include "undine/analysis/exact/channel.hpp"
#include "undine/analysis/exact/drop.hpp"
#include "undine/analysis/exact/drop_in_force.hpp"
#include "undine/analysis/exact/hydrostatic.hpp"
#include "undine/analysis/exact/noh.hpp"
#include "undine/analysis/exact/riemann.hpp"
#include "undine/analysis/exact/sedov.hpp"
#include "undine/analysis/exact/sound_wave.hpp"
#include "undine/analysis/exact/taylor_green.hpp"
#include "undine/core/catalogue.hpp"

namespace undine::exact {

/// The one list of exact solutions.
using ExactSolutions = Catalogue<  //
    Riemann,                       //
    Sedov,                         //
    Noh,                           //
    TaylorGreen,                   //
    Poiseuille,                    //
    Couette,                       //
    HydrostaticIncompressible,     //
    HydrostaticLinear,             //
    HydrostaticTait,               //
    SoundWave,                     //
    DropOscillation,               //
    DropPressure,                  //
    DropInForce,                   //
    Cavity>;

template <class List>
struct VariantOf;
template <class... Entries>
struct VariantOf<Catalogue<Entries...>> {
  using type = std::variant<Entries...>;
};

/// Any one of them, with its parameters.
using ExactSolution = VariantOf<ExactSolutions>::type;

/// The solution of that index with its default parameters.
inline ExactSolution make_solution(int index) {
  return ExactSolutions::visit(index, [](auto solution) { return ExactSolution{solution}; });
}

}  // namespace undine::exact
