#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "undine/core/catalogue.hpp"
#include "undine/core/domain.hpp"

namespace undine {

/// Finds points near a point. Every search gives the same answer in the same order (ascending index), so results do not
/// depend on the choice by a single bit.
template <int N>
class NeighbourSearch {
 public:
  virtual ~NeighbourSearch() = default;

  /// Takes the points (which must outlive the search and not move) and the largest radius that will be asked for.
  virtual void build(std::span<const Vec<N>> points, double radius, const Domain<N>& domain) = 0;

  /// Replaces `found` by the indices of all points with |x - point| < radius, nearest periodic image counted,
  /// ascending.
  virtual void find(const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const = 0;

  virtual std::size_t bytes() const = 0;
};

/// The searches that a case file can name, in the order of `undine list searches`.
std::vector<Info> search_infos();

/// A search by its name. Throws InputError when there is none of that name.
template <int N>
std::unique_ptr<NeighbourSearch<N>> make_search(const std::string& name);

}  // namespace undine
