#pragma once

// The namespace of what is compiled once per instruction set: isa_v2, isa_v3, isa_v4 for x86-64-v2, -v3, -v4, given by
// the build, or isa_native for the compiler's own choice. Only names that contain it leave such an object file
// (cmake/instruction_sets.cmake), so that no inline function built for a newer processor is linked into the rest.
#ifndef UNDINE_ISA
#define UNDINE_ISA isa_native
#endif

namespace undine::UNDINE_ISA {

/// Names the instruction set in template arguments.
struct Tag;

}  // namespace undine::UNDINE_ISA
