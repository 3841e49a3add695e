#pragma once

/// Inlines all that a function calls: for hot loops. Not under the address sanitizer, whose checks would make such a
/// function take many minutes to compile.
#if defined(__SANITIZE_ADDRESS__)
#define UNDINE_FLATTEN
#else
#define UNDINE_FLATTEN [[gnu::flatten]]
#endif
