// The pair loops of every term, compiled once for each instruction set: cmake/instruction_sets.cmake.
#include "unit/engine/every_term.hpp"

#include "undine/engine/sweep_loop.hpp"

namespace undine {

template struct CompiledSweep<test::EveryTerm<1>>;
template struct CompiledSweep<test::EveryTerm<2>>;
template struct CompiledSweep<test::EveryTerm<3>>;

}  // namespace undine
