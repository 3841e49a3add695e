#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "undine/engine/store.hpp"
#include "undine/search/search.hpp"

namespace undine {

/// For each target of a group, the indices (in the store) of the particles of a source group within the list radius,
/// ascending.
class NeighbourList {
 public:
  /// Targets that share one array; small enough to balance splashes, large enough to cost nothing.
  static constexpr std::size_t targets_per_part = 512;

  /// Fills the list in parallel: `find(target, found)` gives the sources of one target, to which `offset` is added.
  /// Arrays keep their memory from one build to the next.
  template <class Find>
  void fill(std::size_t targets, std::size_t offset, Find&& find);

  std::span<const std::uint32_t> of(std::size_t target) const {
    const Part& part = parts_[target / targets_per_part];
    const std::size_t t = target % targets_per_part;
    return {part.indices.data() + part.starts[t], part.starts[t + 1] - part.starts[t]};
  }
  std::size_t pairs() const;
  std::size_t bytes() const;

 private:
  struct Part {
    std::vector<std::uint32_t> starts, indices;
  };
  std::vector<Part> parts_;
};

/// Neighbour lists of all groups, with a skin so that they hold while particles move less than half of it. Building
/// them sorts the particles by space: by cell of the list radius, then by id, so that order depends on positions alone
/// and not on history.
template <int N>
class Neighbours {
 public:
  struct Options {
    std::string search = "cell_grid";
    double skin = 0.1;        ///< extra list radius as a fraction of the support radius
    bool store_lists = true;  ///< false: each query asks the search (the serial reference)
  };

  Neighbours(const Domain<N>& domain, Options options);

  /// Sorts the store, remembers the positions in x_list, and builds search and lists for pairs closer than `support`.
  void build(Store<N>& store, double support);
  /// Builds search and lists from x_list as it stands, without sorting: after reading a checkpoint.
  void rebuild_from_list_positions(Store<N>& store, double support);
  /// Whether some particle moved, or the support grew, further than the skin allows.
  bool stale(const Store<N>& store, double support) const;

  /// Sources of one target (index within its group) as store indices. `scratch` holds the answer when no lists are
  /// stored.
  std::span<const std::uint32_t> of(Group target_group, std::size_t target, Group source_group, const Store<N>& store,
                                    std::vector<std::uint32_t>& scratch) const;
  /// Particles of a group that may lie within the support radius of a point.
  void near_point(const Vec<N>& x, Group group, const Store<N>& store, std::vector<std::uint32_t>& found) const;

  double support() const { return support_; }
  double list_radius() const { return list_radius_; }
  std::size_t bytes() const;
  std::size_t pair_count(Group target, Group source) const { return list(target, source).pairs(); }

 private:
  void sort_by_space(Store<N>& store);
  void build_lists(Store<N>& store);
  const NeighbourList& list(Group target, Group source) const {
    return lists_[static_cast<int>(target)][static_cast<int>(source)];
  }

  Domain<N> domain_;
  Options options_;
  double support_ = 0, list_radius_ = 0;
  std::unique_ptr<NeighbourSearch<N>> searches_[group_count];
  NeighbourList lists_[group_count][group_count];
};

extern template class Neighbours<1>;
extern template class Neighbours<2>;
extern template class Neighbours<3>;

}  // namespace undine
