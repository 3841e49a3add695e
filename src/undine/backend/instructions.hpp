#pragma once
#include <array>
#include <stdexcept>
#include <string_view>

namespace undine {

/// Instruction sets that the pair loops are compiled for, in one program; which one runs is chosen at start. Basic is
/// what the whole program needs (x86-64-v2 on PCs); avx2 and avx512 are x86-64-v3 and x86-64-v4.
enum class InstructionSet { basic, avx2, avx512 };
inline constexpr std::array<std::string_view, 3> instruction_set_names{"basic", "avx2", "avx512"};

/// Whether the program holds loops for that set and this machine can run them.
bool can_run(InstructionSet set);
/// The widest that can run here.
InstructionSet best_instructions();

#if defined(UNDINE_HAS_ISA_V2)
namespace isa_v2 {
struct Tag;
}
namespace isa_v3 {
struct Tag;
}
namespace isa_v4 {
struct Tag;
}
/// The set that every program has loops for, the plain ones among them.
using BasicTag = isa_v2::Tag;
#else
namespace isa_native {
struct Tag;
}
using BasicTag = isa_native::Tag;
#endif

/// Calls f.operator()<Tag>() with the tag (core/isa.hpp) of what is compiled for that set. The set must be one that
/// `can_run`.
template <class F>
decltype(auto) with_instructions(InstructionSet set, F&& f) {
#if defined(UNDINE_HAS_ISA_V2)
#if defined(UNDINE_HAS_ISA_V4)
  if (set == InstructionSet::avx512) return f.template operator()<isa_v4::Tag>();
#endif
#if defined(UNDINE_HAS_ISA_V3)
  if (set == InstructionSet::avx2) return f.template operator()<isa_v3::Tag>();
#endif
  if (set == InstructionSet::basic) return f.template operator()<isa_v2::Tag>();
#else
  if (set == InstructionSet::basic) return f.template operator()<isa_native::Tag>();
#endif
  throw std::logic_error("no loops are compiled for that instruction set");
}

}  // namespace undine
