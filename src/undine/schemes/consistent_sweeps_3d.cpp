// Compiled once for each instruction set: cmake/instruction_sets.cmake.
#include "undine/engine/sweep_loop.hpp"
#include "undine/schemes/consistent_sweeps.hpp"

namespace undine {

using Sweeps = ConsistentSweeps<3>;
template struct CompiledSweep<Sweeps::Force>;
template struct CompiledSweep<Sweeps::Continuity>;
template struct CompiledSweep<Sweeps::Shift>;

}  // namespace undine
