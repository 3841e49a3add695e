#pragma once

namespace undine::test {

/// Whether this is the build with sanitizers, which looks for errors of memory, arithmetic and threads, not at
/// accuracy, and is ten times slower. Long tests then take fewer steps or sets through the same code, and leave out the
/// criteria that need them all: these are for the usual build.
inline constexpr bool under_sanitizer = UNDINE_UNDER_SANITIZER;

/// n in the usual build, one part of it with sanitizers.
constexpr int fewer(int n, int parts = 10) { return under_sanitizer ? n / parts : n; }

}  // namespace undine::test
