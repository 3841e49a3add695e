#pragma once
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "undine/backend/instructions.hpp"
#include "undine/engine/list_codes.hpp"
#include "undine/engine/neighbour_list.hpp"
#include "undine/engine/store.hpp"
#include "undine/search/pencils.hpp"
#include "undine/search/search.hpp"

namespace undine {

/// Where the neighbours of a target come from. All give the same ones in the same order.
enum class Lists {
  automatic,  ///< stored as long as they fit into the memory that they may take, else free
  stored,     ///< listed once for all sweeps until particles have moved by the skin
  free,       ///< picked from the cells around whenever they are asked for
  plain       ///< the named search is asked for each target: the reference
};

inline constexpr std::array<std::string_view, 4> lists_names{"auto", "stored", "free", "plain"};

/// Neighbours of all particles within the list radius, which has a skin so that they hold while particles move less
/// than half of it. A build sorts the particles by cells of space, then by id, so that order depends on positions alone
/// and not on history.
///
/// Particles may have supports of their own. Two are then neighbours within the larger of their list radii,
/// H (1 + skin) each, and particles are sorted by classes of H first, the widest first, each half an octave of widths.
/// Every class has cells of its own, so that a few wide particles do not make everybody everybody's candidate.
template <int N>
class Neighbours {
 public:
  struct Options {
    std::string search = "cell_grid";
    double skin = 0.1;          ///< extra list radius as a fraction of the support radius
    bool own_supports = false;  ///< whether particles have supports of their own, in the store's fields h and h_list
    Lists lists = Lists::automatic;
    InstructionSet instructions = best_instructions();
    double list_memory = 0;  ///< bytes that automatic lists may take; 0: a quarter of the machine's memory
  };

  Neighbours(const Domain<N>& domain, Options options);

  /// Sorts the store, remembers the positions in x_list and own supports in h_list, and finds pairs closer than
  /// `support`, which is the largest where particles have their own.
  void build(Store<N>& store, double support);
  /// Finds pairs from x_list and h_list as they stand, without sorting: after reading a checkpoint.
  void rebuild_from_list_positions(Store<N>& store, double support);
  /// Whether some particle moved, or the support grew, further than the skin allows.
  bool stale(const Store<N>& store, double support) const;

  /// Work space of one thread, which holds what was found where no lists are stored. Targets that lie in one cell are
  /// found together: ask for one after the other.
  class Scratch;

  /// Sources of one target (index within its group) as store indices, valid until the next call with the same scratch;
  /// walls have no wall neighbours.
  std::span<const std::uint32_t> of(Group target_group, std::size_t target, Group source_group, const Store<N>& store,
                                    Scratch& scratch) const {
    if (stored_) return list(target_group, source_group).of(target);
    return find(target_group, target, source_group, store, scratch);
  }
  /// For single questions: the list in `scratch`.
  std::span<const std::uint32_t> of(Group target_group, std::size_t target, Group source_group, const Store<N>& store,
                                    std::vector<std::uint32_t>& scratch) const;
  /// Particles of a group that may lie within the support radius, the largest of all, of a point.
  void near_point(const Vec<N>& x, Group group, const Store<N>& store, std::vector<std::uint32_t>& found) const;

  double support() const { return support_; }
  double list_radius() const { return list_radius_; }
  /// Whether lists are stored since the last build.
  bool stored() const { return stored_; }
  /// What the last build chose and why, for people.
  std::string describe() const;
  std::size_t bytes() const;
  /// Of those, the bytes of the stored lists.
  std::size_t list_bytes() const;
  /// Pairs on the stored lists; 0 if none are stored.
  std::size_t pair_count(Group target, Group source) const { return list(target, source).pairs(); }
  /// Wall-clock time of all builds: sorting, and listing.
  double seconds_sort() const { return seconds_sort_; }
  double seconds_lists() const { return seconds_lists_; }

 private:
  class CellFinder;
  class SearchFinder;
  using Cell = typename CellFrame<N>::Cell;
  static constexpr int most_classes = 16;

  /// Particles of like list radius.
  struct SizeClass {
    double search_radius = 0;  ///< of the widest, m
    CellFrame<N> frame;
    std::vector<Cell> reach;  ///< how many cells of this frame a target of each class sees
  };
  /// Those of one class in one group, which lie side by side in the store.
  struct Part {
    IndexRange range;
    Pencils<N> pencils;
    std::unique_ptr<NeighbourSearch<N>> search;  ///< only where it is asked
  };

  void start(double support, const Box<N>& box, std::span<const double> own_supports, std::size_t particles);
  void choose_classes(std::span<const double> own_supports);
  void sort_by_space(Store<N>& store);
  void sort_group(Store<N>& store, Group group);
  bool take_order(Store<N>& store, Group group);
  void join_classes(const Store<N>& store);
  void build_lists(const Store<N>& store);
  void build_searches(std::span<const Vec<N>> x);
  bool own_stale(const Store<N>& store) const;
  std::size_t class_of(std::size_t particle) const { return classes_.size() == 1 ? 0 : class_of_[particle]; }
  double list_bytes_allowed() const;
  /// Bytes of all lists, from a sample of targets.
  double estimated_list_bytes(const Store<N>& store) const;
  /// Calls f(make_finder) for the finder in use.
  template <class F>
  decltype(auto) with_finder(Group target, Group source, const Store<N>& store, F&& f) const;
  std::span<const std::uint32_t> find(Group target_group, std::size_t target, Group source_group, const Store<N>& store,
                                      Scratch& scratch) const;
  const NeighbourList& list(Group target, Group source) const {
    return lists_[static_cast<int>(target)][static_cast<int>(source)];
  }

  Domain<N> domain_;
  Options options_;
  double support_ = 0, list_radius_ = 0;
  std::vector<SizeClass> classes_;        ///< one where all have the same support
  std::vector<Part> parts_[group_count];  ///< one for each class, some without particles
  std::vector<double> radii_;             ///< list radii of the particles, where they have their own
  std::vector<std::uint8_t> class_of_;    ///< then also the class of each
  ListCodes<N> codes_;
  PairTest<N> test_{};
  bool ask_search_ = false;  ///< whether each target asks the named search
  bool far_apart_ = false;   ///< whether cells are so wide that candidates do not fit 16 bits: all are tested singly
  bool stored_ = false;
  double list_bytes_needed_ = 0;  ///< estimated, where lists are automatic
  NeighbourList lists_[group_count][group_count];
  std::uint64_t builds_ = 0;
  double seconds_sort_ = 0, seconds_lists_ = 0;
};

template <int N>
class Neighbours<N>::Scratch {
  friend class Neighbours;
  struct Batch {
    std::size_t first = 0, last = 0;  ///< targets
    std::vector<std::uint32_t> found, ends;
  };
  const Neighbours* owner_ = nullptr;
  std::uint64_t build_ = 0;
  Group target_group_{};
  Batch batches_[group_count];
  std::vector<Candidates<N>> runs_;
};

extern template class Neighbours<1>;
extern template class Neighbours<2>;
extern template class Neighbours<3>;

}  // namespace undine
