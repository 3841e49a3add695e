#pragma once
#include <string_view>

// The namespace of what is compiled once per instruction set: isa_v2, isa_v3, isa_v4 for x86-64-v2, -v3, -v4, given by
// the build, or isa_native for the compiler's own choice. Only names that contain it leave such an object file
// (cmake/instruction_sets.cmake), so that no inline function built for a newer processor is linked into the rest.
#ifndef UNDINE_ISA
#define UNDINE_ISA isa_native
#endif

#define UNDINE_TEXT_OF(name) #name
#define UNDINE_TEXT(name) UNDINE_TEXT_OF(name)

namespace undine::UNDINE_ISA {

/// Names the instruction set in template arguments.
struct Tag;

/// Whether this is the set that every machine has, in which the reference is compiled.
inline constexpr bool is_basic =
    std::string_view(UNDINE_TEXT(UNDINE_ISA)) == "isa_v2" || std::string_view(UNDINE_TEXT(UNDINE_ISA)) == "isa_native";

}  // namespace undine::UNDINE_ISA

#undef UNDINE_TEXT
#undef UNDINE_TEXT_OF
