#include "undine/app/setup/filling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

namespace undine {
namespace {

constexpr double bytes_per_particle = 500;  ///< fields and neighbour lists, about

/// Bytes that a run may take: the machine's, or less where the process or UNDINE_MEMORY (in bytes) is limited to less.
double memory_here() {
  double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (rlimit limit{}; getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    memory = std::min(memory, static_cast<double>(limit.rlim_cur));
  if (const char* allowed = std::getenv("UNDINE_MEMORY"))
    if (const double bytes = std::strtod(allowed, nullptr); bytes > 0) memory = std::min(memory, bytes);
  return memory;
}

/// How many points of the lattice a box holds; `margin` (m) is added on each side, or taken off where negative.
double lattice_points(const Bounds& box, const Filling& filling, double margin) {
  const double least = margin < 0 ? 0 : 1;  // a flat box holds one layer, what is inside its skin may be nothing
  double count = 1;
  for (int k = 0; k < filling.dimensions; ++k)
    count *= std::max(least, (box.hi[k] - box.lo[k] + 2 * margin) / filling.spacing);
  return count;
}

}  // namespace

void check_room(const Table& table, double count, double spacing) {
  const double memory = memory_here();
  if (count * bytes_per_particle <= memory) return;
  throw InputError(
      {.what = "the spacing makes more particles than this machine can hold",
       .where = table.where(),
       .why = fmt::format("about {:.2g} particles {:.4g} m apart would take {:.2g} GB of the {:.2g} GB here", count,
                          spacing, count * bytes_per_particle * 1e-9, memory * 1e-9),
       .fix = "choose a larger spacing or a smaller body; lengths are in metres"});
}

void check_filling(const Table& table, const Shape& shape, const Filling& filling) {
  const Bounds box = shape.bounds();
  for (int k = 0; k < filling.dimensions; ++k)
    if (!std::isfinite(box.lo[k]) || !std::isfinite(box.hi[k])) return;  // filling says so
  const double depth = filling.layers * filling.spacing;
  const bool outside = filling.side == Side::outside;
  const double tried = lattice_points(box, filling, outside ? depth : 0);
  const double spared = filling.layers == 0 ? 0 : lattice_points(box, filling, outside ? 0 : -depth);
  // Other shapes may take up little of their bounds; what they do take is checked once it is known.
  check_room(table, shape.as_box() ? tried - spared : 0.1 * tried, filling.spacing);
}

}  // namespace undine
