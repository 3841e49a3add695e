#pragma once
#include <bit>
#include <concepts>
#include <cstdint>

#include "undine/core/value.hpp"

namespace undine {
namespace detail {

/// What `exponential` needs to know of a format. `q` is the minimax polynomial, lowest power first, of
/// (e^r - 1 - r) / r^2 for |r| <= ln(2)/2, by relative error of e^r: 3.1e-9 for float, 3.6e-18 for double (Remez).
template <class T>
struct ExpFormat;

template <>
struct ExpFormat<float> {
  using Bits = std::uint32_t;
  static constexpr int mantissa_bits = 23;
  static constexpr float bias = 127;
  static constexpr float lowest = -105, highest = 89;  ///< from there on e^x is 0, and infinite
  static constexpr float ln_2_high = 0x1.63p-1f, ln_2_low = -0x1.bd0106p-13f;
  static constexpr float q[] = {0x1.fffffcp-2f, 0x1.555492p-3f, 0x1.5558f2p-5f, 0x1.1239d6p-7f, 0x1.6a2448p-10f};
};

template <>
struct ExpFormat<double> {
  using Bits = std::uint64_t;
  static constexpr int mantissa_bits = 52;
  static constexpr double bias = 1023;
  static constexpr double lowest = -746, highest = 710;
  static constexpr double ln_2_high = 0x1.62e42feep-1, ln_2_low = 0x1.a39ef35793c76p-33;
  static constexpr double q[] = {0x1.000000000000ap-1,  0x1.55555555554fap-3,  0x1.555555555088ap-5,
                                 0x1.1111111127ba6p-7,  0x1.6c16c18426facp-10, 0x1.a01a012a67467p-13,
                                 0x1.a0199a154a861p-16, 0x1.71df253d338d7p-19, 0x1.28ad6a2dbeb42p-22,
                                 0x1.ad7f7a12c0ad1p-26};
};

/// A number that, added to a small one, leaves that rounded to a whole number in the lowest bits of the mantissa.
template <class T>
inline constexpr T rounder = T(3) * static_cast<T>(typename ExpFormat<T>::Bits{1} << (ExpFormat<T>::mantissa_bits - 1));

/// 2^k for a whole number k within the range of normal exponents. Needs `V(...).native()` unless V is a number.
template <class T, class V>
constexpr V power_of_two(const V& k) {
  using Format = ExpFormat<T>;
  // The lowest bits of the sum are the biased exponent; the shift drops what is above them.
  const V exponent = k + V(rounder<T> + Format::bias);
  if constexpr (std::floating_point<V>) {
    return std::bit_cast<V>(std::bit_cast<typename Format::Bits>(exponent) << Format::mantissa_bits);
  } else {
    using Native = typename V::Native;
    typedef typename Format::Bits Bits __attribute__((vector_size(sizeof(Native))));
    return V(std::bit_cast<Native>(std::bit_cast<Bits>(exponent.native()) << Format::mantissa_bits));
  }
}

/// The polynomial of those coefficients, even and odd powers apart: half as long a chain of operations.
template <class V, class T, int size>
constexpr V polynomial(const T (&c)[size], const V& r, const V& r_sq) {
  static_assert(size >= 2);
  V last = V(c[size - 1]), before = V(c[size - 2]);
  for (int k = size - 3; k >= 0; --k) {
    const V next = last * r_sq + V(c[k]);
    last = before;
    before = next;
  }
  return last * r + before;
}

}  // namespace detail

/// e^x to within 1.1 units in the last place, without branches and calls; T is the number type inside the value type V,
/// a number itself or a pack. It is 0, a subnormal number and infinity where the rounded e^x is, and NaN for NaN.
///   x = n ln 2 + r, |r| <= ln(2)/2;  e^x = 2^n (1 + r + r^2 q(r))
template <class T, class V>
constexpr V exponential(const V& x) {
  using Format = detail::ExpFormat<T>;
  constexpr T round = detail::rounder<T>;
  constexpr T log2_e = T(1.44269504088896340736);
  const V low = select(x < V(Format::lowest), V(Format::lowest), x);
  const V y = select(low > V(Format::highest), V(Format::highest), low);

  const V n = (y * V(log2_e) + V(round)) - V(round);
  const V r = (y - n * V(Format::ln_2_high)) - n * V(Format::ln_2_low);
  const V r_sq = r * r;
  const V exp_r = (detail::polynomial(Format::q, r, r_sq) * r_sq + r) + V(1);
  // 2^n itself may be out of range where the result is not, or is subnormal: in two halves.
  const V half = (n * V(T(0.5)) + V(round)) - V(round);
  return exp_r * detail::power_of_two<T>(half) * detail::power_of_two<T>(n - half);
}

}  // namespace undine
