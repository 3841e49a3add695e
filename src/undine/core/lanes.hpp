#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#if defined(__AVX__)
#include <immintrin.h>
#endif

#include "undine/core/pack.hpp"

namespace undine::detail {

/// Records to lanes: out[k][lane] = number k of record index[lane], for first <= k < last (multiples of 4).
/// `components` is the distance from one record to the next.
template <class V, int components>
struct LoadLanes {
  template <int first, int last>
  static void load(const scalar_of<V>* records, const std::uint32_t* index, V (&out)[components]) {
    for (int k = first; k < last; ++k) {
      if constexpr (lanes_of<V> == 1) {
        out[k] = records[std::size_t{index[0]} * components + k];
      } else {
        out[k] = V::generate([&](int lane) { return records[std::size_t{index[lane]} * components + k]; });
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
  static_assert(components % 4 == 0);
  typedef T Four __attribute__((vector_size(4 * sizeof(T))));
  typedef T All __attribute__((vector_size(lanes * sizeof(T))));

  template <int begin, int end>
  [[gnu::always_inline]] static void load(const T* records, const std::uint32_t* index, Pack<T> (&out)[components]) {
    All rows[4][components / 4];
    for (int l = 0; l < 4; ++l) {
      const T* from[lanes / 4];
      for (int j = 0; j < lanes / 4; ++j) from[j] = records + std::size_t{index[l + 4 * j]} * components;
      for (int k = begin; k < end; k += 4) rows[l][k / 4] = side_by_side(from, k);
    }
    for (int k = begin; k < end; k += 4) {
      using Groups = std::make_integer_sequence<int, lanes>;
      const All &row0 = rows[0][k / 4], &row1 = rows[1][k / 4], &row2 = rows[2][k / 4], &row3 = rows[3][k / 4];
      const All low01 = low(row0, row1, Groups{}), high01 = high(row0, row1, Groups{});
      const All low23 = low(row2, row3, Groups{}), high23 = high(row2, row3, Groups{});
      out[k] = pack(first(low01, low23, Groups{}));
      out[k + 1] = pack(second(low01, low23, Groups{}));
      out[k + 2] = pack(first(high01, high23, Groups{}));
      out[k + 3] = pack(second(high01, high23, Groups{}));
    }
  }

 private:
  [[gnu::always_inline]] static Pack<T> pack(const All& all) {
    return Pack<T>(std::bit_cast<typename Pack<T>::Native>(all));
  }
  [[gnu::always_inline]] static Four four(const T* row) {
    Four elements;
    std::memcpy(&elements, row, sizeof(Four));
    return elements;
  }
  template <int... I, class Part>
  [[gnu::always_inline]] static auto joined(const Part& a, const Part& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, I...);
  }

  /// Elements k .. k+3 of the rows one after the other; joined in registers, for a detour through memory stalls.
  [[gnu::always_inline]] static All side_by_side(const T* const* from, int k) {
    if constexpr (lanes == 4) {
      return four(from[0] + k);
    } else {
#if defined(__AVX512F__)
      if constexpr (lanes == 16) {  // inserts straight from memory
        __m512 all = _mm512_castps128_ps512(_mm_loadu_ps(from[0] + k));
        all = _mm512_insertf32x4(all, _mm_loadu_ps(from[1] + k), 1);
        all = _mm512_insertf32x4(all, _mm_loadu_ps(from[2] + k), 2);
        return std::bit_cast<All>(_mm512_insertf32x4(all, _mm_loadu_ps(from[3] + k), 3));
      }
#endif
      using Eight = std::make_integer_sequence<int, 8>;
      const auto front = joined(four(from[0] + k), four(from[1] + k), Eight{});
      if constexpr (lanes == 8) {
        return front;
      } else {
        const auto back = joined(four(from[2] + k), four(from[3] + k), Eight{});
        return joined(front, back, std::make_integer_sequence<int, 16>{});
      }
    }
  }

  // Within each group of four: {a0, b0, a1, b1}, {a2, b2, a3, b3}, {a0, a1, b0, b1}, {a2, a3, b2, b3}.
  template <int... I>
  [[gnu::always_inline]] static All low(const All& a, const All& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (I / 4 * 4 + I % 4 / 2 + I % 2 * lanes)...);
  }
  template <int... I>
  [[gnu::always_inline]] static All high(const All& a, const All& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (I / 4 * 4 + 2 + I % 4 / 2 + I % 2 * lanes)...);
  }
  template <int... I>
  [[gnu::always_inline]] static All first(const All& a, const All& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (I / 4 * 4 + I % 2 + I % 4 / 2 * lanes)...);
  }
  template <int... I>
  [[gnu::always_inline]] static All second(const All& a, const All& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, (I / 4 * 4 + 2 + I % 2 + I % 4 / 2 * lanes)...);
  }
};

}  // namespace undine::detail
