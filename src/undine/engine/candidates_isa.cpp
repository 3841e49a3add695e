// Compiled once for each instruction set: cmake/instruction_sets.cmake.
#include "undine/engine/candidates.hpp"

namespace undine {

template <class Tag>
const PruneTable& prune_table() {
  static const PruneTable table{prune<1>, prune<2>, prune<3>};
  return table;
}

template const PruneTable& prune_table<UNDINE_ISA::Tag>();

}  // namespace undine
