#pragma once
#include <string>
#include <vector>

#include "undine/schemes/flow.hpp"

namespace undine {

/// A term's part of an acceleration, with the group that it comes from.
template <int N>
struct ForcePart {
  std::string term;  ///< "pressure (wall)"
  Vec<N> acc{};      ///< m/s^2
};

/// The acceleration of one particle of fluid (index in the store), term by term: each use of the force sweep runs alone
/// on a store of the particle and its neighbours, one pair at a time and in double. Changes nothing in the flow, whose
/// lists must exist. Empty where the particle has no place.
template <int N>
std::vector<ForcePart<N>> force_parts(const Flow<N>& flow, std::size_t particle);

}  // namespace undine
