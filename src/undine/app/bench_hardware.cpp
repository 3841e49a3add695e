#include "undine/app/bench_hardware.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <omp.h>

#include "undine/core/pack.hpp"

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
  return fmt::format("{}, {} cores, vectors of {} bits", processor(), omp_get_num_procs(), 32 * lanes_of<Pack<float>>);
}

}  // namespace undine
