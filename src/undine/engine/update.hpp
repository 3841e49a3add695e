#pragma once
#include <algorithm>
#include <iterator>
#include <vector>

#include "undine/engine/store.hpp"

namespace undine {

/// Particles per task of an update, and per partial sum of a total: fixed, so that sums do not depend on the number of
/// threads.
inline constexpr std::size_t particles_per_block = 1024;

/// Calls f(i) for each particle of a group, in parallel. Each call may change its own particle only.
template <int N, class F>
void for_each_particle(const Store<N>& store, Group group, F&& f) {
  const IndexRange r = store.range(group);
#pragma omp parallel for schedule(static)
  for (std::size_t i = r.begin; i < r.end; ++i) f(i);
}

/// Sum of f(i) over a group, in blocks of fixed size: the same bits for any number of threads.
template <int N, class F>
auto total_over(const Store<N>& store, Group group, F&& f) {
  using Value = decltype(f(std::size_t{}));
  const IndexRange r = store.range(group);
  const std::size_t blocks = (r.size() + particles_per_block - 1) / particles_per_block;
  std::vector<Value> parts(blocks);
#pragma omp parallel for schedule(static)
  for (std::size_t block = 0; block < blocks; ++block) {
    Value part{};
    const std::size_t last = std::min(r.end, r.begin + (block + 1) * particles_per_block);
    for (std::size_t i = r.begin + block * particles_per_block; i < last; ++i) part += f(i);
    parts[block] = part;
  }
  Value total{};
  for (const Value& part : parts) total += part;
  return total;
}

/// Largest f(i) over a group, component by component where f gives vectors; `lowest` when the group is empty.
template <int N, class Value, class F>
Value largest_over(const Store<N>& store, Group group, const Value& lowest, F&& f) {
  const auto join = [](Value& largest, const Value& value) {
    if constexpr (is_vec<Value>) {
      for (std::size_t k = 0; k < std::size(largest.c); ++k) largest.c[k] = std::max(largest.c[k], value.c[k]);
    } else {
      largest = std::max(largest, value);
    }
  };
  const IndexRange r = store.range(group);
  Value largest = lowest;
#pragma omp parallel
  {
    Value part = lowest;
#pragma omp for schedule(static) nowait
    for (std::size_t i = r.begin; i < r.end; ++i) join(part, f(i));
#pragma omp critical(undine_largest_over)
    join(largest, part);
  }
  return largest;
}

/// Runs a particle update U: a struct with `reads`, `writes` and a pure function of one particle's row (and its
/// material).
template <int N, class U>
void update(Store<N>& store, Group group, const U& rule) {
  using Reads = typename U::reads;
  using Writes = typename U::writes;
  for_each_particle(store, group, [&](std::size_t i) {
    typename Reads::template Row<N, double> a;
    Reads::for_each([&]<class F>(F) { F::of(a) = store.template get<F>()[i]; });
    const auto row = rule(a, store.materials()[i]);
    Writes::for_each([&]<class F>(F) { store.template get<F>()[i] = F::of(row); });
  });
}

}  // namespace undine
