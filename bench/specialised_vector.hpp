#pragma once
#include <immintrin.h>

// The few vector operations of the loop written by hand, for AVX-512 and AVX2. Independent of core/pack.hpp and
// engine/lanes.hpp on purpose: what those lose, the comparison must show.

namespace specialised {

#if defined(__AVX512F__) && defined(__AVX512DQ__)

inline constexpr int lanes = 16;
typedef float V __attribute__((vector_size(64)));

inline V sqrt(V a) { return V(_mm512_sqrt_ps(__m512(a))); }
inline V max(V a, V b) { return V(_mm512_max_ps(__m512(a), __m512(b))); }
inline V min(V a, V b) { return V(_mm512_min_ps(__m512(a), __m512(b))); }
inline V abs(V a) { return V(_mm512_abs_ps(__m512(a))); }
inline V all(float a) { return V(_mm512_set1_ps(a)); }
/// a where x < y, else 0.
inline V where_less(V x, V y, V a) {
  return V(_mm512_maskz_mov_ps(_mm512_cmp_ps_mask(__m512(x), __m512(y), _CMP_LT_OQ), __m512(a)));
}
/// Difference of fixed-point positions, as float.
inline V code_difference(V a, V b) {
  return V(_mm512_cvtepi32_ps(_mm512_sub_epi32(_mm512_castps_si512(__m512(a)), _mm512_castps_si512(__m512(b)))));
}
inline float largest(V a) { return _mm512_reduce_max_ps(__m512(a)); }

inline V unpack_low(V a, V b) { return V(_mm512_unpacklo_ps(__m512(a), __m512(b))); }
inline V unpack_high(V a, V b) { return V(_mm512_unpackhi_ps(__m512(a), __m512(b))); }
inline V halves_low(V a, V b) { return V(_mm512_shuffle_ps(__m512(a), __m512(b), 0x44)); }
inline V halves_high(V a, V b) { return V(_mm512_shuffle_ps(__m512(a), __m512(b), 0xee)); }
/// Four floats each from rows 0, 4, 8, 12.
inline V side_by_side(const float* const* from, int k) {
  const __m256 front =
      _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from[0] + k)), _mm_loadu_ps(from[4] + k), 1);
  const __m256 back =
      _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from[8] + k)), _mm_loadu_ps(from[12] + k), 1);
  return V(_mm512_insertf32x8(_mm512_castps256_ps512(front), back, 1));
}
inline __m128 sum_of_quarters(V a) {
  const __m256 half = _mm256_add_ps(_mm512_castps512_ps256(__m512(a)), _mm512_extractf32x8_ps(__m512(a), 1));
  return _mm_add_ps(_mm256_castps256_ps128(half), _mm256_extractf128_ps(half, 1));
}

#elif defined(__AVX2__)

inline constexpr int lanes = 8;
typedef float V __attribute__((vector_size(32)));

inline V sqrt(V a) { return V(_mm256_sqrt_ps(__m256(a))); }
inline V max(V a, V b) { return V(_mm256_max_ps(__m256(a), __m256(b))); }
inline V min(V a, V b) { return V(_mm256_min_ps(__m256(a), __m256(b))); }
inline V all(float a) { return V(_mm256_set1_ps(a)); }
inline V abs(V a) { return V(_mm256_andnot_ps(_mm256_set1_ps(-0.0F), __m256(a))); }
inline V where_less(V x, V y, V a) {
  return V(_mm256_and_ps(_mm256_cmp_ps(__m256(x), __m256(y), _CMP_LT_OQ), __m256(a)));
}
inline V code_difference(V a, V b) {
  return V(_mm256_cvtepi32_ps(_mm256_sub_epi32(_mm256_castps_si256(__m256(a)), _mm256_castps_si256(__m256(b)))));
}
inline float largest(V a) {
  float most = a[0];
  for (int k = 1; k < lanes; ++k) most = a[k] > most ? a[k] : most;
  return most;
}
inline V unpack_low(V a, V b) { return V(_mm256_unpacklo_ps(__m256(a), __m256(b))); }
inline V unpack_high(V a, V b) { return V(_mm256_unpackhi_ps(__m256(a), __m256(b))); }
inline V halves_low(V a, V b) { return V(_mm256_shuffle_ps(__m256(a), __m256(b), 0x44)); }
inline V halves_high(V a, V b) { return V(_mm256_shuffle_ps(__m256(a), __m256(b), 0xee)); }
inline V side_by_side(const float* const* from, int k) {
  return V(_mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(from[0] + k)), _mm_loadu_ps(from[4] + k), 1));
}
inline __m128 sum_of_quarters(V a) {
  return _mm_add_ps(_mm256_castps256_ps128(__m256(a)), _mm256_extractf128_ps(__m256(a), 1));
}

#else
#error "the loop by hand is written for AVX2 and AVX-512: configure with UNDINE_ARCH=native or x86-64-v3"
#endif

/// Rows to lanes: out[k][lane] = from[lane][k], four k at a time. Lane 4 j + l comes from element j of row l.
template <int width>
inline void transpose(const float* const* from, V* out) {
  for (int k = 0; k < width; k += 4) {
    const V row0 = side_by_side(from, k), row1 = side_by_side(from + 1, k), row2 = side_by_side(from + 2, k),
            row3 = side_by_side(from + 3, k);
    const V low01 = unpack_low(row0, row1), low23 = unpack_low(row2, row3);
    const V high01 = unpack_high(row0, row1), high23 = unpack_high(row2, row3);
    out[k] = halves_low(low01, low23);
    out[k + 1] = halves_high(low01, low23);
    out[k + 2] = halves_low(high01, high23);
    out[k + 3] = halves_high(high01, high23);
  }
}

/// The sums over the lanes of four vectors at once.
inline void sum_four(V a, V b, V c, V d, float* out) {
  const V ab = unpack_low(a, b) + unpack_high(a, b), cd = unpack_low(c, d) + unpack_high(c, d);
  _mm_storeu_ps(out, sum_of_quarters(halves_low(ab, cd) + halves_high(ab, cd)));
}

}  // namespace specialised
