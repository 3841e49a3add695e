#include "undine/engine/store.hpp"

#include <algorithm>

namespace undine {
namespace {

/// Rows of `width` numbers: row begin + k takes what was in row begin + order[k].
template <int width, class T>
void permute_rows(std::vector<T>& data, std::size_t begin, std::span<const std::uint32_t> order, Workspace& workspace) {
  const auto moved = workspace.take<T>(order.size() * width);
  T* const rows = data.data() + begin * width;
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < order.size(); ++k)
      for (int c = 0; c < width; ++c) moved[k * width + c] = rows[std::size_t{order[k]} * width + c];
#pragma omp for schedule(static)
    for (std::size_t k = 0; k < moved.size(); ++k) rows[k] = moved[k];
  }
}

template <class T>
void insert_rows(std::vector<T>& rows, std::size_t width, std::size_t at, std::size_t n, T value) {
  rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(at * width), n * width, value);
}

template <class T>
void remove_rows(std::vector<T>& rows, std::size_t width, const std::vector<char>& flags) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) continue;
    std::copy_n(rows.data() + i * width, width, rows.data() + kept * width);
    ++kept;
  }
  rows.resize(kept * width);
}

}  // namespace

template <int N>
void Store<N>::allocate(const FieldSet& fields) {
  fields_ |= fields;
  for (int f = 0; f < FieldId::count; ++f)
    if (fields_[f]) data_[f].resize(size() * all_fields[f].components(N), 0.0);
}

template <int N>
std::size_t Store<N>::append(Group group, std::size_t n, int material) {
  const std::size_t at = range(group).end;
  for (int f = 0; f < FieldId::count; ++f)
    if (fields_[f]) insert_rows(data_[f], all_fields[f].components(N), at, n, 0.0);
  insert_rows(ids_, 1, at, n, std::int64_t{0});
  insert_rows(materials_, 1, at, n, static_cast<std::int32_t>(material));
  for (std::size_t k = 0; k < n; ++k) ids_[at + k] = next_id_++;
  counts_[static_cast<int>(group)] += n;
  return at;
}

template <int N>
void Store<N>::remove(const std::vector<char>& flags) {
  std::array<std::size_t, group_count> gone{};
  for (const Group group : all_groups) {
    const IndexRange r = range(group);
    for (std::size_t i = r.begin; i < r.end; ++i) gone[static_cast<int>(group)] += flags[i] != 0;
  }
  for (int g = 0; g < group_count; ++g) counts_[g] -= gone[g];
  for (int f = 0; f < FieldId::count; ++f)
    if (fields_[f]) remove_rows(data_[f], all_fields[f].components(N), flags);
  remove_rows(ids_, 1, flags);
  remove_rows(materials_, 1, flags);
}

template <int N>
void Store<N>::permute(Group group, std::span<const std::uint32_t> order) {
  const IndexRange r = range(group);
  for (int f = 0; f < FieldId::count; ++f) {
    if (!fields_[f]) continue;
    const int width = all_fields[f].components(N);
    if (width == 1) permute_rows<1>(data_[f], r.begin, order, workspace_);
    if (width == N && N > 1) permute_rows<N>(data_[f], r.begin, order, workspace_);
    if (width == N * N && N > 1) permute_rows<N * N>(data_[f], r.begin, order, workspace_);
  }
  permute_rows<1>(ids_, r.begin, order, workspace_);
  permute_rows<1>(materials_, r.begin, order, workspace_);
}

template <int N>
void Store<N>::keep(const FieldSet& fields) {
  fields_ &= fields;
  for (int f = 0; f < FieldId::count; ++f)
    if (!fields_[f]) data_[f] = std::vector<double>();  // assigning {} would keep the memory
}

template <int N>
IndexRange Store<N>::range(Group group) const {
  return group == Group::fluid ? IndexRange{0, counts_[0]} : IndexRange{counts_[0], counts_[0] + counts_[1]};
}

template <int N>
std::size_t Store<N>::bytes() const {
  std::size_t total = ids_.capacity() * sizeof(std::int64_t) + materials_.capacity() * sizeof(std::int32_t);
  for (const auto& data : data_) total += data.capacity() * sizeof(double);
  return total + workspace_.bytes();
}

template class Store<1>;
template class Store<2>;
template class Store<3>;

}  // namespace undine
