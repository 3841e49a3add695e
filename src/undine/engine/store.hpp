#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "undine/core/domain.hpp"
#include "undine/core/fields.hpp"
#include "undine/core/workspace.hpp"

namespace undine {

/// Particles of one group lie side by side; sweeps and updates run over groups.
enum class Group { fluid, wall };
inline constexpr std::array<Group, 2> all_groups{Group::fluid, Group::wall};
inline constexpr int group_count = 2;

/// A contiguous range of particles.
struct IndexRange {
  std::size_t begin = 0, end = 0;
  std::size_t size() const { return end - begin; }
};

/// All particles of a run as one array per field (vectors as N numbers side by side), in double. Only fields that were
/// asked for take memory. Order: fluid, then wall; inside a group as the engine sorted it.
template <int N>
class Store {
 public:
  /// Makes room for the fields; new entries are zero.
  void allocate(const FieldSet& fields);
  /// Gives up the memory of all other fields.
  void keep(const FieldSet& fields);
  /// Appends n particles to a group (zero in every field, ids continuing) and returns the index of the first.
  std::size_t append(Group group, std::size_t n, int material);
  /// Removes the particles whose flag is set (flags.size() == size()).
  void remove(const std::vector<char>& flags);
  /// Reorders one group: new position k of the group takes what was at order[k] (indices within the group). Spans of
  /// before are not valid any more.
  void permute(Group group, std::span<const std::uint32_t> order);

  std::size_t size() const { return ids_.size(); }
  IndexRange range(Group group) const;
  const FieldSet& fields() const { return fields_; }

  /// The values of one field: double for scalars, Vec<N> for vectors, Vec<N, Vec<N>> for tensors.
  template <class Tag>
  std::span<typename Tag::template value<N, double>> get() {
    auto& data = data_[Tag::id];
    return {reinterpret_cast<typename Tag::template value<N, double>*>(data.data()), fields_[Tag::id] ? size() : 0};
  }
  template <class Tag>
  std::span<const typename Tag::template value<N, double>> get() const {
    const auto& data = data_[Tag::id];
    return {reinterpret_cast<const typename Tag::template value<N, double>*>(data.data()),
            fields_[Tag::id] ? size() : 0};
  }
  /// The numbers of one field, components side by side; empty when the field is not in use.
  std::span<double> raw(int field) { return data_[field]; }
  std::span<const double> raw(int field) const { return data_[field]; }

  std::span<std::int64_t> ids() { return ids_; }
  std::span<const std::int64_t> ids() const { return ids_; }
  std::span<std::int32_t> materials() { return materials_; }
  std::span<const std::int32_t> materials() const { return materials_; }
  /// What every job on the particles may use, one after the other.
  Workspace& workspace() { return workspace_; }
  std::size_t bytes() const;

 private:
  FieldSet fields_;
  std::array<std::vector<double>, FieldId::count> data_;
  std::vector<std::int64_t> ids_;
  std::vector<std::int32_t> materials_;
  std::array<std::size_t, group_count> counts_{};
  std::int64_t next_id_ = 0;
  Workspace workspace_;
};

extern template class Store<1>;
extern template class Store<2>;
extern template class Store<3>;

}  // namespace undine
