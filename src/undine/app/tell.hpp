#pragma once
#include <cstdio>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace undine {

/// Prints to a terminal, pipe or file that may be gone by then, which is no error: a run goes on unheard.
template <class... Args>
void tell(std::FILE* to, fmt::format_string<Args...> text, Args&&... args) {
  const std::string line = fmt::format(text, std::forward<Args>(args)...);
  std::fwrite(line.data(), 1, line.size(), to);
}

}  // namespace undine
