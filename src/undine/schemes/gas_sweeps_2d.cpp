// Compiled once for each instruction set: cmake/instruction_sets.cmake.
#include "undine/engine/sweep_loop.hpp"
#include "undine/schemes/gas_sweeps.hpp"

namespace undine {

template struct CompiledSweep<GasSweeps<2>::Density>;
template struct CompiledSweep<GasSweeps<2>::Rate>;
template struct CompiledSweep<GasSweeps<2>::Force>;
template struct CompiledSweep<GasSweeps<2>::Foresight>;

}  // namespace undine
