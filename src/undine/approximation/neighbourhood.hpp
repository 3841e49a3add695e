#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "undine/approximation/stencil.hpp"
#include "undine/core/vec.hpp"

namespace undine::approximation {

/// What a method sees: the points within the support of a centre x_c. All is free of units, lengths in support radii H,
/// so that its systems do not depend on the unit of length.
template <int N>
struct Neighbourhood {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  std::vector<Vec<N>> s;       ///< (x_j - x_c)/H, |s| < 1
  std::vector<double> V;       ///< volumes V_j/H^N; empty unless the method asks for them
  std::vector<double> W;       ///< W(x_c - x_j) H^N
  std::vector<Vec<N>> dW;      ///< grad W H^(N+1), the derivative with respect to x_c
  std::vector<Matrix<N>> ddW;  ///< grad grad W H^(N+2); empty where the kernel has a kink at R = 0
  std::size_t centre = none;   ///< which point is x_c, for methods that expand about a point

  std::size_t size() const { return s.size(); }
};

}  // namespace undine::approximation
