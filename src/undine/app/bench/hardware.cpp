#include "undine/app/bench/hardware.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <omp.h>

#include "undine/backend/instructions.hpp"

namespace undine {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown processor";
}

}  // namespace

std::string bench_hardware() {
  return fmt::format("{}, {} cores, {} loops", processor(), omp_get_num_procs(),
                     instruction_set_names[static_cast<std::size_t>(best_instructions())]);
}

}  // namespace undine
