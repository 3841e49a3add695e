#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "undine/app/case_scheme.hpp"
#include "undine/geometry/surface.hpp"
#include "undine/schemes/wall_motion.hpp"

namespace undine {

/// A wall as one of a surface's.
struct PlacedSurface {
  std::shared_ptr<ReflectingSurface> surface;
  std::size_t wall;
};

/// The motion that a wall's keys `displacement` and `slide` describe, if they do; it takes the wall's surfaces along.
/// `fastest` (m/s) becomes the largest speed until time.end if that is larger. Throws InputError at the key.
template <int N>
std::optional<WallMotion<N>> read_wall_motion(const Table& table, const SchemeChoice& choice,
                                              const std::vector<PlacedSurface>& surfaces, double& fastest);

extern template std::optional<WallMotion<1>> read_wall_motion<1>(const Table&, const SchemeChoice&,
                                                                 const std::vector<PlacedSurface>&, double&);
extern template std::optional<WallMotion<2>> read_wall_motion<2>(const Table&, const SchemeChoice&,
                                                                 const std::vector<PlacedSurface>&, double&);
extern template std::optional<WallMotion<3>> read_wall_motion<3>(const Table&, const SchemeChoice&,
                                                                 const std::vector<PlacedSurface>&, double&);

}  // namespace undine
