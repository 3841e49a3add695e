#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "undine/engine/store.hpp"
#include "undine/materials/catalogue.hpp"
#include "undine/walls/mirrors.hpp"

namespace undine {

/// The ghost particles of a flow. They are the wall group of its store, made anew at each build of the neighbour lists
/// and set after their parents before each sum. A ghost's id is negative and made of its parent's and of its mirror, so
/// that their order depends on positions alone, and parents are found again after reading a checkpoint.
template <int N>
class Ghosts {
 public:
  Ghosts(std::shared_ptr<const walls::Mirrors<N>> mirrors, const Domain<N>& domain);

  /// Replaces the wall group by the ghosts of all fluid particles nearer than `reach` to a wall.
  void make(Store<N>& store, double reach) const;
  /// Finds the parents after particles were sorted or read.
  void find_parents(const Store<N>& store);
  /// Places and velocities, and the support.
  void follow(Store<N>& store) const;
  /// Density, pressure and speed of sound. p_g = p, or with `gravity` p + rho g.(x_g - x); never below the pressure at
  /// rest unless the wall may pull.
  void answer(Store<N>& store, const Vec<N>& gravity, bool pulls,
              const std::vector<materials::Material>& materials) const;

  /// The same value for scalars, its mirror image for vectors and symmetric tensors: as parents have it.
  void mirror(Store<N>& store, const FieldSet& fields) const;

  /// The mirror of a ghost, from its id.
  static int mirror_of(std::int64_t id) { return static_cast<int>((-1 - id) % most_mirrors); }

 private:
  static constexpr std::int64_t most_mirrors = 1 << 16;
  static std::int64_t id_of(std::int64_t parent, int mirror) { return -1 - (parent * most_mirrors + mirror); }
  static std::int64_t parent_of(std::int64_t id) { return (-1 - id) / most_mirrors; }

  Vec<N> parent_place(const Store<N>& store, std::size_t parent) const;

  std::shared_ptr<const walls::Mirrors<N>> mirrors_;
  Domain<N> domain_;
  std::vector<std::uint32_t> parents_;      ///< index in the store, of each ghost
  std::vector<std::uint32_t> index_of_id_;  ///< of fluid particles; work space
};

extern template class Ghosts<1>;
extern template class Ghosts<2>;
extern template class Ghosts<3>;

}  // namespace undine
