#include "undine/app/machine.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <omp.h>
#include <sys/utsname.h>
#include <unistd.h>

namespace undine {

Machine this_machine() {
  Machine machine{.processor = "unknown processor", .cores = omp_get_num_procs(), .memory_gb = 0, .system = {}};
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      machine.processor = line.substr(std::min(line.size(), line.find(':') + 2));
      break;
    }
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  if (pages > 0 && size > 0)
    machine.memory_gb = std::round(static_cast<double>(pages) * static_cast<double>(size) * 1e-8) / 10;
  utsname name;
  if (uname(&name) == 0) machine.system = std::string(name.sysname) + " " + name.release + " " + name.machine;
  return machine;
}

}  // namespace undine
