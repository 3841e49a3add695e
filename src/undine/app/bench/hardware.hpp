#pragma once
#include <string>

namespace undine {

/// The machine, in words, for whoever reads a figure later.
std::string bench_hardware();

}  // namespace undine
