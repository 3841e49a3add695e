#pragma once
#include "undine/search/search.hpp"

namespace undine {

/// Looks at every point: O(n) a query. The reference that the other searches are tested against.
template <int N>
class AllPairs final : public NeighbourSearch<N> {
 public:
  static constexpr Info info{"all_pairs", "Every point against every point, O(n^2)", "|x_a - x_b| < R",
                             "Saalfeld (2012), ch. 6"};

  void build(std::span<const Vec<N>> points, double, const Domain<N>& domain) override {
    points_ = points;
    domain_ = domain;
  }

  void find(const Vec<N>& x, double radius, std::vector<std::uint32_t>& found) const override {
    found.clear();
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (norm_sq(domain_.nearest_image(x - points_[i])) < sq(radius)) found.push_back(static_cast<std::uint32_t>(i));
  }

  std::size_t bytes() const override { return 0; }

 private:
  std::span<const Vec<N>> points_;
  Domain<N> domain_;
};

}  // namespace undine
