#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "undine/core/vec.hpp"

namespace undine {

/// The point sets that `undine bench search` asks about.
enum class SearchSetKind {
  uniform,   ///< a cube, its lattice jittered by a fifth of the spacing
  clustered  ///< clusters of 500 points, with density as 1/r^2 around their centres, in a mostly empty box
};
inline constexpr std::array<std::string_view, 2> search_set_names{"uniform", "clustered"};

/// Points in the order in which the engine keeps particles, by the cells of a grid, and a radius within which a point
/// finds about 60 others on the mean, however many points there are.
struct SearchSet {
  std::vector<Vec<3>> points;
  double radius = 0;
};
SearchSet make_search_set(SearchSetKind kind, int particles);

}  // namespace undine
