#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace undine {

/// What `undine list` and `undine show` say of one entry of an axis.
struct Info {
  std::string_view name;      ///< the word in a case file
  std::string_view title;     ///< one line for a table
  std::string_view equation;  ///< in plain text, with the symbols of the code
  std::string_view citation;  ///< author (year), equation number
};

/// The list of one axis: each entry is a struct with `static constexpr Info info`. Case-file names, help, error
/// suggestions, docs tables and the automatic tests are all derived from it.
template <class... Entries>
struct Catalogue {
  static constexpr int size = static_cast<int>(sizeof...(Entries));

  static constexpr Info info(int index) {
    constexpr Info all[] = {Entries::info...};
    return all[index];
  }

  /// Index of the entry of that name, or -1.
  static constexpr int index_of(std::string_view name) {
    for (int k = 0; k < size; ++k)
      if (info(k).name == name) return k;
    return -1;
  }

  static std::vector<std::string> names() { return {std::string(Entries::info.name)...}; }

  template <class Entry>
  static constexpr int index() {
    return index_of(Entry::info.name);
  }

  /// Calls f(Entry{}) for the entry of that index; the index is uniform over a block of pairs, so this is one
  /// predictable jump.
  template <class F>
  [[gnu::always_inline]] static constexpr decltype(auto) visit(int index, F&& f) {
    return visit_from<0, F, Entries...>(index, f);
  }

  template <class F>
  static constexpr void for_each(F&& f) {
    (f(Entries{}), ...);
  }

 private:
  template <int K, class F, class Head, class... Tail>
  [[gnu::always_inline]] static constexpr decltype(auto) visit_from(int index, F& f) {
    if constexpr (sizeof...(Tail) == 0) {
      return f(Head{});
    } else {
      if (index == K) return f(Head{});
      return visit_from<K + 1, F, Tail...>(index, f);
    }
  }
};

}  // namespace undine
