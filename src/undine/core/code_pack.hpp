#pragma once
#include <cstdint>
#include <cstdlib>

#if defined(__AVX2__) || defined(__SSE4_1__)
#include <immintrin.h>
#endif

namespace undine {

/// A vector register of pairs of 16-bit numbers, one pair in each 32-bit lane. Whole numbers: every instruction set
/// gives the same answers.
class CodePack {
 public:
#if defined(__AVX512BW__)
  using Native = __m512i;
#elif defined(__AVX2__)
  using Native = __m256i;
#elif defined(__SSE4_1__)
  using Native = __m128i;
#else
  using Native = std::int32_t;
#endif
  static constexpr int lanes = sizeof(Native) / sizeof(std::int32_t);

  CodePack() = default;
  /// Every lane this pair.
  [[gnu::always_inline]] explicit CodePack(std::int32_t pair);
  /// From memory aligned to the size of the register.
  [[gnu::always_inline]] static CodePack load(const std::int32_t* pairs);

  /// Difference of each number, modulo 2^16.
  friend CodePack operator-(const CodePack& a, const CodePack& b);
  /// Magnitudes of 16-bit numbers; that of -2^15 is 2^15, without sign.
  friend CodePack magnitude(const CodePack& a);
  /// The lesser of each two numbers without sign.
  friend CodePack lesser(const CodePack& a, const CodePack& b);
  /// In each lane a^2 + b^2 of its pair (a, b).
  friend CodePack squares(const CodePack& a);
  /// Sum of 32-bit lanes.
  friend CodePack sum(const CodePack& a, const CodePack& b);
  /// The larger of each two 32-bit lanes.
  friend CodePack larger(const CodePack& a, const CodePack& b);
  /// Those of the `asked` bits k for which the number in lane k is below the limit.
  [[gnu::always_inline]] std::uint32_t below(const CodePack& limit, std::uint32_t asked) const;

 private:
  explicit CodePack(const Native& native, int) : native_(native) {}
  Native native_;
};

#if defined(__AVX512BW__)
[[gnu::always_inline]] inline CodePack::CodePack(std::int32_t pair) : native_(_mm512_set1_epi32(pair)) {}
[[gnu::always_inline]] inline CodePack CodePack::load(const std::int32_t* pairs) {
  return CodePack(_mm512_load_si512(pairs), 0);
}
[[gnu::always_inline]] inline CodePack operator-(const CodePack& a, const CodePack& b) {
  return CodePack(_mm512_sub_epi16(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack magnitude(const CodePack& a) { return CodePack(_mm512_abs_epi16(a.native_), 0); }
[[gnu::always_inline]] inline CodePack lesser(const CodePack& a, const CodePack& b) {
  return CodePack(_mm512_min_epu16(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack squares(const CodePack& a) {
  return CodePack(_mm512_madd_epi16(a.native_, a.native_), 0);
}
[[gnu::always_inline]] inline CodePack sum(const CodePack& a, const CodePack& b) {
  return CodePack(_mm512_add_epi32(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack larger(const CodePack& a, const CodePack& b) {
  return CodePack(_mm512_max_epi32(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline std::uint32_t CodePack::below(const CodePack& limit, std::uint32_t asked) const {
  return _mm512_mask_cmplt_epi32_mask(static_cast<__mmask16>(asked), native_, limit.native_);
}
#elif defined(__AVX2__)
[[gnu::always_inline]] inline CodePack::CodePack(std::int32_t pair) : native_(_mm256_set1_epi32(pair)) {}
[[gnu::always_inline]] inline CodePack CodePack::load(const std::int32_t* pairs) {
  return CodePack(_mm256_load_si256(reinterpret_cast<const __m256i*>(pairs)), 0);
}
[[gnu::always_inline]] inline CodePack operator-(const CodePack& a, const CodePack& b) {
  return CodePack(_mm256_sub_epi16(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack magnitude(const CodePack& a) { return CodePack(_mm256_abs_epi16(a.native_), 0); }
[[gnu::always_inline]] inline CodePack lesser(const CodePack& a, const CodePack& b) {
  return CodePack(_mm256_min_epu16(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack squares(const CodePack& a) {
  return CodePack(_mm256_madd_epi16(a.native_, a.native_), 0);
}
[[gnu::always_inline]] inline CodePack sum(const CodePack& a, const CodePack& b) {
  return CodePack(_mm256_add_epi32(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack larger(const CodePack& a, const CodePack& b) {
  return CodePack(_mm256_max_epi32(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline std::uint32_t CodePack::below(const CodePack& limit, std::uint32_t asked) const {
  const __m256i less = _mm256_cmpgt_epi32(limit.native_, native_);
  return static_cast<std::uint32_t>(_mm256_movemask_ps(_mm256_castsi256_ps(less))) & asked;
}
#elif defined(__SSE4_1__)
[[gnu::always_inline]] inline CodePack::CodePack(std::int32_t pair) : native_(_mm_set1_epi32(pair)) {}
[[gnu::always_inline]] inline CodePack CodePack::load(const std::int32_t* pairs) {
  return CodePack(_mm_load_si128(reinterpret_cast<const __m128i*>(pairs)), 0);
}
[[gnu::always_inline]] inline CodePack operator-(const CodePack& a, const CodePack& b) {
  return CodePack(_mm_sub_epi16(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack magnitude(const CodePack& a) { return CodePack(_mm_abs_epi16(a.native_), 0); }
[[gnu::always_inline]] inline CodePack lesser(const CodePack& a, const CodePack& b) {
  return CodePack(_mm_min_epu16(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack squares(const CodePack& a) {
  return CodePack(_mm_madd_epi16(a.native_, a.native_), 0);
}
[[gnu::always_inline]] inline CodePack sum(const CodePack& a, const CodePack& b) {
  return CodePack(_mm_add_epi32(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline CodePack larger(const CodePack& a, const CodePack& b) {
  return CodePack(_mm_max_epi32(a.native_, b.native_), 0);
}
[[gnu::always_inline]] inline std::uint32_t CodePack::below(const CodePack& limit, std::uint32_t asked) const {
  const __m128i less = _mm_cmplt_epi32(native_, limit.native_);
  return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(less))) & asked;
}
#else
namespace detail {

/// f of the low and of the high numbers.
template <class F>
std::int32_t by_halves(F&& f) {
  const auto half = [&](int shift) {
    return static_cast<std::uint32_t>(static_cast<std::uint16_t>(f(shift))) << shift;
  };
  return static_cast<std::int32_t>(half(16) | half(0));
}

}  // namespace detail

[[gnu::always_inline]] inline CodePack::CodePack(std::int32_t pair) : native_(pair) {}
[[gnu::always_inline]] inline CodePack CodePack::load(const std::int32_t* pairs) { return CodePack(*pairs); }
[[gnu::always_inline]] inline CodePack operator-(const CodePack& a, const CodePack& b) {
  return CodePack(detail::by_halves([&](int shift) { return (a.native_ >> shift) - (b.native_ >> shift); }));
}
[[gnu::always_inline]] inline CodePack magnitude(const CodePack& a) {
  return CodePack(
      detail::by_halves([&](int shift) { return std::abs(int{static_cast<std::int16_t>(a.native_ >> shift)}); }));
}
[[gnu::always_inline]] inline CodePack lesser(const CodePack& a, const CodePack& b) {
  return CodePack(detail::by_halves([&](int shift) {
    const auto p = static_cast<std::uint16_t>(a.native_ >> shift), q = static_cast<std::uint16_t>(b.native_ >> shift);
    return p < q ? p : q;
  }));
}
[[gnu::always_inline]] inline CodePack squares(const CodePack& a) {
  const std::int32_t low = static_cast<std::int16_t>(a.native_), high = a.native_ >> 16;
  return CodePack(low * low + high * high);
}
[[gnu::always_inline]] inline CodePack sum(const CodePack& a, const CodePack& b) {
  return CodePack(a.native_ + b.native_);
}
[[gnu::always_inline]] inline CodePack larger(const CodePack& a, const CodePack& b) {
  return a.native_ < b.native_ ? b : a;
}
[[gnu::always_inline]] inline std::uint32_t CodePack::below(const CodePack& limit, std::uint32_t asked) const {
  return native_ < limit.native_ ? asked : 0;
}
#endif

}  // namespace undine
