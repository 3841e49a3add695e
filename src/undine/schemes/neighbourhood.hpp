#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "undine/engine/neighbours.hpp"

namespace undine {

/// A particle of fluid with all that may act on it, as a store and lists of their own: for questions about that
/// particle alone, which may then change what they like.
template <int N>
struct Neighbourhood {
  Store<N> store;
  Neighbours<N> lists;
  std::size_t centre = 0;  ///< index of the particle in the store

  Neighbourhood(const Store<N>& all, const Neighbours<N>& neighbours, const Domain<N>& domain, std::size_t particle)
      : lists(domain, {.search = "all_pairs", .lists = Lists::plain}) {
    store.allocate(all.fields());
    std::vector<std::uint32_t> found;
    for (const Group group : all_groups) {
      neighbours.near_point(all.template get<field::x>()[particle], group, all, found);
      const bool has_centre = std::ranges::count(found, static_cast<std::uint32_t>(particle)) > 0;
      if (group == Group::fluid && !has_centre) found.push_back(static_cast<std::uint32_t>(particle));
      const std::size_t first = store.append(group, found.size(), 0);
      for (std::size_t k = 0; k < found.size(); ++k) take(all, found[k], first + k);
    }
    lists.build(store, neighbours.support());
    const auto ids = store.ids();
    centre = static_cast<std::size_t>(std::ranges::find(ids, all.ids()[particle]) - ids.begin());
  }

 private:
  void take(const Store<N>& all, std::size_t from, std::size_t to) {
    store.ids()[to] = all.ids()[from];
    store.materials()[to] = all.materials()[from];
    for (int f = 0; f < FieldId::count; ++f) {
      if (!all.fields()[static_cast<std::size_t>(f)]) continue;
      const auto n = static_cast<std::size_t>(all_fields[static_cast<std::size_t>(f)].components(N));
      for (std::size_t k = 0; k < n; ++k) store.raw(f)[to * n + k] = all.raw(f)[from * n + k];
    }
  }
};

}  // namespace undine
