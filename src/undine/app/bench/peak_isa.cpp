// Compiled once for each instruction set: cmake/instruction_sets.cmake.
#include <algorithm>
#include <cmath>
#include <utility>

#include <omp.h>

#include "undine/app/bench/peak.hpp"
#include "undine/core/isa.hpp"
#include "undine/core/pack.hpp"

namespace undine {
namespace {

constexpr int chains = 12;  ///< latency 4, two a cycle, and some to spare; 14 registers of the 16 of AVX2

/// Chains of multiply-adds that do not wait for each other; the result keeps the compiler from leaving them out.
/// Constant indices alone keep them in registers.
template <class V, int... K>
V multiply_adds(long rounds, std::integer_sequence<int, K...>) {
  V sums[]{V(0.1 * K)...};
  const V factor(0.999), addend(1e-3);
  for (long r = 0; r < rounds; ++r) ((sums[K] = sums[K] * factor + addend), ...);
  return (sums[K] + ...);
}

template <class V>
double peak_of(int threads) {
  constexpr long rounds = 2000000;
  constexpr double flops = 2.0 * chains * lanes_of<V> * rounds;
  double best = 0, sink = 0;
  for (int repeat = 0; repeat < 9; ++repeat) {
    const double start = omp_get_wtime();
#pragma omp parallel num_threads(threads) reduction(+ : sink)
    sink += static_cast<double>(lane_sum(multiply_adds<V>(rounds, std::make_integer_sequence<int, chains>{})));
    best = std::max(best, flops * threads / (omp_get_wtime() - start));
  }
  return std::isfinite(sink) ? best : 0;
}

}  // namespace

template <class Tag>
double fma_peak(PairPrecision precision, int threads) {
  return precision == PairPrecision::mixed ? peak_of<Pack<float>>(threads) : peak_of<Pack<double>>(threads);
}

template double fma_peak<UNDINE_ISA::Tag>(PairPrecision, int);

}  // namespace undine
