#pragma once
#include <bit>
#include <cstring>
#include <utility>

#include "undine/core/pack.hpp"

namespace undine::detail {

/// Records to lanes: out[k][lane] = from[lane][k] for k < components (a multiple of 4; whole groups of four are read).
template <class V, int components>
struct LoadLanes {
  static void load(const scalar_of<V>* const* from, V (&out)[components]) {
    for (int k = 0; k < components; ++k) {
      if constexpr (lanes_of<V> == 1) {
        out[k] = from[0][k];
      } else {
        out[k] = V::generate([&](int lane) { return from[lane][k]; });
      }
    }
  }
};

/// Packs of 4, 8 or 16 lanes: four components at a time by 4 x 4 transpositions in registers, a third of the work of
/// loading number by number. Lane 4 j + l of a group comes from element j of row l, so rows l, l + 4, l + 8, ... are
/// loaded side by side.
template <class T, int components>
requires(Pack<T>::lanes == 4 || Pack<T>::lanes == 8 || Pack<T>::lanes == 16) struct LoadLanes<Pack<T>, components> {
  static constexpr int lanes = Pack<T>::lanes;
  typedef T Four __attribute__((vector_size(4 * sizeof(T))));
  typedef T All __attribute__((vector_size(lanes * sizeof(T))));

  static void load(const T* const* from, Pack<T> (&out)[components]) {
    static_assert(components % 4 == 0);
    for (int k = 0; k < components; k += 4) {
      const All row0 = side_by_side(from, k), row1 = side_by_side(from + 1, k), row2 = side_by_side(from + 2, k),
                row3 = side_by_side(from + 3, k);
      using Groups = std::make_integer_sequence<int, lanes>;
      const All low01 = low(row0, row1, Groups{}), high01 = high(row0, row1, Groups{});
      const All low23 = low(row2, row3, Groups{}), high23 = high(row2, row3, Groups{});
      out[k] = pack(first(low01, low23, Groups{}));
      out[k + 1] = pack(second(low01, low23, Groups{}));
      out[k + 2] = pack(first(high01, high23, Groups{}));
      out[k + 3] = pack(second(high01, high23, Groups{}));
    }
  }

 private:
  static Pack<T> pack(const All& all) { return Pack<T>(std::bit_cast<typename Pack<T>::Native>(all)); }

  static Four four(const T* row) {
    Four elements;
    std::memcpy(&elements, row, sizeof(Four));
    return elements;
  }
  template <int... I, class Part>
  static auto joined(const Part& a, const Part& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, I...);
  }

  /// Elements k .. k+3 of rows 0, 4, 8, ... one after the other; joined in registers, for a detour through memory
  /// stalls.
  static All side_by_side(const T* const* from, int k) {
    if constexpr (lanes == 4) {
      return four(from[0] + k);
    } else {
      using Eight = std::make_integer_sequence<int, 8>;
      const auto front = joined(four(from[0] + k), four(from[4] + k), Eight{});
      if constexpr (lanes == 8) {
        return front;
      } else {
        const auto back = joined(four(from[8] + k), four(from[12] + k), Eight{});
        return joined(front, back, std::make_integer_sequence<int, 16>{});
      }
    }
  }

  // Within each group of four: {a0, b0, a1, b1}, {a2, b2, a3, b3}, {a0, a1, b0, b1}, {a2, a3, b2, b3}.
  template <int... I>
  static All low(const All& a, const All& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (I / 4 * 4 + I % 4 / 2 + I % 2 * lanes)...);
  }
  template <int... I>
  static All high(const All& a, const All& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (I / 4 * 4 + 2 + I % 4 / 2 + I % 2 * lanes)...);
  }
  template <int... I>
  static All first(const All& a, const All& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (I / 4 * 4 + I % 2 + I % 4 / 2 * lanes)...);
  }
  template <int... I>
  static All second(const All& a, const All& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (I / 4 * 4 + 2 + I % 2 + I % 4 / 2 * lanes)...);
  }
};

}  // namespace undine::detail
