// Compiled once for each instruction set: cmake/instruction_sets.cmake.
#include "undine/engine/sweep_loop.hpp"
#include "undine/schemes/weakly_compressible_sweeps.hpp"

namespace undine {

using Sweeps = WeaklyCompressibleSweeps<1>;
template struct CompiledSweep<Sweeps::Force>;
template struct CompiledSweep<Sweeps::Continuity>;
template struct CompiledSweep<Sweeps::Summation>;
template struct CompiledSweep<Sweeps::Shepard>;
template struct CompiledSweep<Sweeps::WallPressure>;
template struct CompiledSweep<Sweeps::WallAnswer>;
template struct CompiledSweep<Sweeps::WallPush>;
template struct CompiledSweep<Sweeps::Gradient>;
template struct CompiledSweep<Sweeps::Strain>;
template struct CompiledSweep<Sweeps::WallForce>;

}  // namespace undine
