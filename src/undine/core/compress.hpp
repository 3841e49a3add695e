#pragma once
#include <array>
#include <bit>
#include <cstdint>

#if defined(__AVX2__) || defined(__SSE4_1__)
#include <immintrin.h>
#endif

namespace undine {
namespace detail {

/// For every byte the positions of the bits that are set, ascending; the unused places are 0.
inline constexpr auto bit_positions = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (int byte = 0; byte < 256; ++byte)
    for (int bit = 0, at = 0; bit < 8; ++bit)
      if (byte >> bit & 1) table[byte][at++] = static_cast<std::uint8_t>(bit);
  return table;
}();

}  // namespace detail

/// Writes first + k for each bit k that is set, ascending, and returns how many those are. Overwrites `width` (1, 4, 8
/// or 16) numbers at `to`, however few bits there are: no branch depends on the bits, and compressing in a register is
/// many times faster on AMD than the instruction that compresses into memory. Without one, bytes are looked up.
template <int width>
[[gnu::always_inline]] inline int write_bits(std::uint32_t* to, std::uint32_t first, std::uint32_t bits) {
#if defined(__AVX512F__)
  if constexpr (width == 16) {
    const __m512i lane = _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    const __m512i numbers = _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)), lane);
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), numbers));
    return std::popcount(bits);
  }
#endif
  if constexpr (width > 8) {
    const int low = write_bits<8>(to, first, bits & 255);
    return low + write_bits<width - 8>(to + low, first + 8, bits >> 8);
  } else {
    const std::uint8_t* positions = detail::bit_positions[bits].data();
#if defined(__AVX2__)
    if constexpr (width == 8) {
      const __m256i numbers = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(positions)));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                          _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)), numbers));
      return std::popcount(bits);
    }
#elif defined(__SSE4_1__)
    if constexpr (width == 4) {
      const __m128i numbers = _mm_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(positions)));
      _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_add_epi32(_mm_set1_epi32(static_cast<int>(first)), numbers));
      return std::popcount(bits);
    }
#endif
    for (int k = 0; k < width; ++k) to[k] = first + positions[k];
    return std::popcount(bits);
  }
}

}  // namespace undine
