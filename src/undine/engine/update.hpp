#pragma once
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

/// Largest f(i) over a group; `lowest` when the group is empty.
template <int N, class F>
double largest_over(const Store<N>& store, Group group, double lowest, F&& f) {
  const IndexRange r = store.range(group);
  double largest = lowest;
#pragma omp parallel for reduction(max : largest) schedule(static)
  for (std::size_t i = r.begin; i < r.end; ++i) largest = std::max(largest, static_cast<double>(f(i)));
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
