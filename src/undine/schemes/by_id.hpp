#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "undine/engine/update.hpp"

namespace undine {

/// The values of a field of one group, kept for their particles however the store is sorted meanwhile.
template <int N>
class ById {
 public:
  void take(const Store<N>& store, Group group, int field) {
    const IndexRange range = store.range(group);
    const auto ids = store.ids();
    width_ = static_cast<std::size_t>(all_fields[field].components(N));
    std::int64_t most = -1;
    for (std::size_t i = range.begin; i < range.end; ++i) most = std::max(most, ids[i]);
    numbers_.resize(static_cast<std::size_t>(most + 1) * width_);
    const double* from = store.raw(field).data();
    for_each_particle(store, group, [&](std::size_t i) {
      std::copy_n(from + i * width_, width_, numbers_.data() + static_cast<std::size_t>(ids[i]) * width_);
    });
  }
  void give_back(Store<N>& store, Group group, int field) const {
    double* to = store.raw(field).data();
    const auto ids = store.ids();
    for_each_particle(store, group, [&](std::size_t i) { std::ranges::copy(of(ids[i]), to + i * width_); });
  }
  std::span<const double> of(std::int64_t id) const {
    return std::span(numbers_).subspan(static_cast<std::size_t>(id) * width_, width_);
  }

 private:
  std::size_t width_ = 1;
  std::vector<double> numbers_;
};

}  // namespace undine
