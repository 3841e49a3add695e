#pragma once
#include <array>
#include <bitset>
#include <string_view>
#include <type_traits>

#include "undine/core/vec.hpp"

namespace undine {

enum class Rank { scalar, vector, tensor };
enum class Role { constant, state, rate, derived };
enum class Join { sum, max };

/// One line of fields.def.
struct FieldInfo {
  std::string_view name;
  Rank rank;
  std::string_view unit;
  Role role;
  Join join;
  std::string_view meaning;

  constexpr int components(int dimensions) const {
    return rank == Rank::scalar ? 1 : rank == Rank::vector ? dimensions : dimensions * dimensions;
  }
};

/// Index of a field in fields.def; `count` is how many there are.
struct FieldId {
  enum : int {
#define FIELD(symbol, ...) symbol,
#include "undine/fields.def"
#undef FIELD
    count
  };
};

inline constexpr std::array<FieldInfo, FieldId::count> all_fields{{
#define FIELD(symbol, rank, unit, role, join, meaning) {#symbol, Rank::rank, unit, Role::role, Join::join, meaning},
#include "undine/fields.def"
#undef FIELD
}};

using FieldSet = std::bitset<FieldId::count>;

template <Rank rank, int N, class V>
using RankValue =
    std::conditional_t<rank == Rank::scalar, V, std::conditional_t<rank == Rank::vector, Vec<N, V>, Vec<N, Vec<N, V>>>>;

/// One tag type per field. A tag knows its line of fields.def, the type of its value in N dimensions over a value type
/// V, and the slot that gives a row the member of its name.
namespace field {
#define FIELD(symbol, rank_, unit_, role_, join_, meaning_)  \
  struct symbol {                                            \
    static constexpr int id = FieldId::symbol;               \
    static constexpr const FieldInfo& info = all_fields[id]; \
    template <int N, class V>                                \
    using value = RankValue<Rank::rank_, N, V>;              \
    template <class T>                                       \
    struct Slot {                                            \
      T symbol;                                              \
    };                                                       \
    template <class Row>                                     \
    static constexpr auto& of(Row& row) {                    \
      return row.symbol;                                     \
    }                                                        \
  };
#include "undine/fields.def"
#undef FIELD
}  // namespace field

/// A set of fields, and the rows that hold one value for each: `row.rho`, `row.acc`.
template <class... F>
struct Fields {
  /// Values given in the order of the list, of whatever type the expressions have.
  template <class... T>
  struct Made : F::template Slot<T>... {};

  template <int N, class V>
  using Row = Made<typename F::template value<N, V>...>;

  template <class... T>
  static constexpr Made<T...> row(const T&... values) {
    static_assert(sizeof...(T) == sizeof...(F), "one value for each field of the list");
    return {{values}...};
  }

  static FieldSet set() {
    FieldSet fields;
    (fields.set(F::id), ...);
    return fields;
  }

  /// Calls f(tag) for each field.
  template <class Function>
  static constexpr void for_each(Function&& f) {
    (f(F{}), ...);
  }

  template <class Tag>
  static constexpr bool has = (std::is_same_v<Tag, F> || ...);
};

namespace detail {
template <class List, class Tag>
struct Insert;
template <class... F, class Tag>
struct Insert<Fields<F...>, Tag> {
  using type = std::conditional_t<Fields<F...>::template has<Tag>, Fields<F...>, Fields<F..., Tag>>;
};
template <class... Lists>
struct UnionOf;
template <class List>
struct UnionOf<List> {
  using type = List;
};
template <class List, class... Rest>
struct UnionOf<List, Fields<>, Rest...> : UnionOf<List, Rest...> {};
template <class List, class Tag, class... Tags, class... Rest>
struct UnionOf<List, Fields<Tag, Tags...>, Rest...>
    : UnionOf<typename Insert<List, Tag>::type, Fields<Tags...>, Rest...> {};
}  // namespace detail

/// All fields of the lists, each once, in the order of first mention.
template <class... Lists>
using Union = typename detail::UnionOf<Fields<>, Lists...>::type;

}  // namespace undine
