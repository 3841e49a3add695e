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

/// Adds the upper half to the lower one until four numbers are left.
template <int n, class All>
[[gnu::always_inline]] inline auto sum_groups(const All& a) {
  if constexpr (n == 4) {
    return a;
  } else {
    const auto half = [&]<int... I>(int first, std::integer_sequence<int, I...>) __attribute__((always_inline)) {
      return first == 0 ? __builtin_shufflevector(a, a, I...) : __builtin_shufflevector(a, a, (I + n / 2)...);
    };
    using Half = std::make_integer_sequence<int, n / 2>;
    return sum_groups<n / 2>(half(0, Half{}) + half(1, Half{}));
  }
}

/// Four numbers each from several places to lanes, and back: 4 x 4 transpositions inside each group of four lanes.
template <class T, int lanes>
struct Fours {
  typedef T Four __attribute__((vector_size(4 * sizeof(T))));
  typedef T All __attribute__((vector_size(lanes * sizeof(T))));
  using Groups = std::make_integer_sequence<int, lanes>;

  /// The four numbers from each of lanes/4 places, one after the other; joined in registers, for a detour through
  /// memory stalls.
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
  [[gnu::always_inline]] static All low(const All& a, const All& b) { return low(a, b, Groups{}); }
  [[gnu::always_inline]] static All high(const All& a, const All& b) { return high(a, b, Groups{}); }
  [[gnu::always_inline]] static All first(const All& a, const All& b) { return first(a, b, Groups{}); }
  [[gnu::always_inline]] static All second(const All& a, const All& b) { return second(a, b, Groups{}); }

 private:
  [[gnu::always_inline]] static Four four(const T* row) {
    Four elements;
    std::memcpy(&elements, row, sizeof(Four));
    return elements;
  }
  template <int... I, class Part>
  [[gnu::always_inline]] static auto joined(const Part& a, const Part& b, std::integer_sequence<int, I...>) {
    return __builtin_shufflevector(a, b, I...);
  }
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

template <class V>
inline constexpr bool has_fours = lanes_of<V> == 4 || lanes_of<V> == 8 || lanes_of<V> == 16;

/// Records to lanes: out[k][lane] = number k of record index[lane], for the `count` numbers (a multiple of 4) of each.
/// Packs of 4, 8 or 16 lanes take four numbers at a time, a third of the work of loading number by number: lane 4 j + l
/// comes from element j of row l, so rows l, l + 4, l + 8, ... are loaded side by side.
template <int count, class V>
[[gnu::always_inline]] inline void load_lanes(const scalar_of<V>* records, const std::uint32_t* index, V* out) {
  static_assert(count % 4 == 0);
  constexpr int lanes = lanes_of<V>;
  if constexpr (lanes == 1) {
    for (int k = 0; k < count; ++k) out[k] = records[std::size_t{index[0]} * count + k];
  } else if constexpr (!has_fours<V>) {
    for (int k = 0; k < count; ++k)
      out[k] = V::generate([&](int lane) { return records[std::size_t{index[lane]} * count + k]; });
  } else {
    using F = Fours<scalar_of<V>, lanes>;
    typename F::All rows[4][count / 4];
    for (int l = 0; l < 4; ++l) {
      const scalar_of<V>* from[lanes / 4];
      for (int j = 0; j < lanes / 4; ++j) from[j] = records + std::size_t{index[l + 4 * j]} * count;
      for (int k = 0; k < count; k += 4) rows[l][k / 4] = F::side_by_side(from, k);
    }
    const auto pack = [](const auto& all) { return V(std::bit_cast<typename V::Native>(all)); };
    for (int k = 0; k < count; k += 4) {
      const auto &row0 = rows[0][k / 4], &row1 = rows[1][k / 4], &row2 = rows[2][k / 4], &row3 = rows[3][k / 4];
      const auto low01 = F::low(row0, row1), high01 = F::high(row0, row1);
      const auto low23 = F::low(row2, row3), high23 = F::high(row2, row3);
      out[k] = pack(F::first(low01, low23));
      out[k + 1] = pack(F::second(low01, low23));
      out[k + 2] = pack(F::first(high01, high23));
      out[k + 3] = pack(F::second(high01, high23));
    }
  }
}

/// The sum over the lanes of each of four packs, always in the same order.
template <class V>
[[gnu::always_inline]] inline void sum_lanes(const V& a, const V& b, const V& c, const V& d, scalar_of<V>* sums) {
  if constexpr (has_fours<V>) {
    using F = Fours<scalar_of<V>, lanes_of<V>>;
    const auto all = [](const V& v) { return std::bit_cast<typename F::All>(v.native()); };
    const auto ab = F::low(all(a), all(b)) + F::high(all(a), all(b));
    const auto cd = F::low(all(c), all(d)) + F::high(all(c), all(d));
    const auto total = sum_groups<lanes_of<V>>(F::first(ab, cd) + F::second(ab, cd));
    std::memcpy(sums, &total, sizeof(total));
  } else {
    sums[0] = lane_sum(a), sums[1] = lane_sum(b), sums[2] = lane_sum(c), sums[3] = lane_sum(d);
  }
}

}  // namespace undine::detail
