#pragma once
#include <string>

namespace undine {

/// What a run was computed on, as far as the system tells.
struct Machine {
  std::string processor;
  int cores = 0;
  double memory_gb = 0;  ///< 1e9 bytes; 0: not known
  std::string system;    ///< such as "Linux 6.1.0 x86_64"
};

Machine this_machine();

}  // namespace undine
