// Compiled once for each instruction set: cmake/instruction_sets.cmake.
#include "undine/engine/sweep_loop.hpp"
#include "undine/schemes/gas_sweeps.hpp"

namespace undine {

template struct CompiledSweep<GasSweeps<3>::Density>;
template struct CompiledSweep<GasSweeps<3>::Rate>;
template struct CompiledSweep<GasSweeps<3>::Force>;
template struct CompiledSweep<GasSweeps<3>::Foresight>;

}  // namespace undine
