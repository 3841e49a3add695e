#pragma once
#include <array>
#include <string_view>

#include "undine/backend/instructions.hpp"

namespace undine {

/// Who runs the loops. `serial` is plain and defines right; `threads` must agree with it; `checked` is serial, poisons
/// what a sweep is to write and finds a term that reads what nothing wrote.
enum class BackendKind { threads, serial, checked };
inline constexpr std::array<std::string_view, 3> backend_names{"threads", "serial", "checked"};

/// Number type of pair arithmetic; state is always double. `mixed` is float on positions relative to the pair.
enum class PairPrecision { mixed, double_precision };
inline constexpr std::array<std::string_view, 2> precision_names{"mixed", "double"};

struct Backend {
  BackendKind kind = BackendKind::threads;
  PairPrecision precision = PairPrecision::mixed;
  InstructionSet instructions = best_instructions();  ///< of the threads backend; the others use the basic set
};

}  // namespace undine
