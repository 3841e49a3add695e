#include "undine/app/run/spinning.hpp"

#include <climits>
#include <cstdlib>

#include <omp.h>
#include <unistd.h>

namespace undine {

void bound_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT") || omp_get_max_threads() == 1) return;
  // By its path, as it would be called 'exe' in the list of processes otherwise.
  char path[PATH_MAX];
  const ssize_t length = readlink("/proc/self/exe", path, sizeof path);
  if (length <= 0 || length == sizeof path) return;
  path[length] = '\0';
  if (setenv("GOMP_SPINCOUNT", "1000", 0) == 0) execv(path, argv);
}

}  // namespace undine
