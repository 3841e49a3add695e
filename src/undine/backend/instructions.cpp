#include "undine/backend/instructions.hpp"

namespace undine {

bool can_run(InstructionSet set) {
#if defined(UNDINE_HAS_ISA_V4)
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
#endif
#if defined(UNDINE_HAS_ISA_V3)
  if (set == InstructionSet::avx2)
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
           __builtin_cpu_supports("bmi2");
#endif
  return set == InstructionSet::basic;
}

InstructionSet best_instructions() {
  for (const InstructionSet set : {InstructionSet::avx512, InstructionSet::avx2})
    if (can_run(set)) return set;
  return InstructionSet::basic;
}

}  // namespace undine
