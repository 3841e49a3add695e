// Compiled once for each instruction set: cmake/instruction_sets.cmake.
#include <algorithm>
#include <cmath>
#include <utility>

#include <omp.h>

#include "undine/app/bench_peak.hpp"
#include "undine/core/isa.hpp"
#include "undine/core/pack.hpp"

namespace undine {
namespace {

constexpr int chains = 12;  ///< latency 4, two a cycle, and some to spare; 14 registers of the 16 of AVX2

/// Chains of multiply-adds that do not wait for each other; the result keeps the compiler from leaving them out.
template <class V>
V multiply_adds(long rounds) {
  V sums[chains];
  for (int k = 0; k < chains; ++k) sums[k] = V(0.1 * k);
  const V factor(0.999), addend(1e-3);
  const auto each = [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
    ((sums[K] = sums[K] * factor + addend), ...);  // constant indices: sums stay in registers
  };
  for (long r = 0; r < rounds; ++r) each(std::make_integer_sequence<int, chains>{});
  V total(0);
  for (int k = 0; k < chains; ++k) total += sums[k];
  return total;
}

template <class V>
double peak_of(int threads) {
  constexpr long rounds = 2000000;
  constexpr double flops = 2.0 * chains * lanes_of<V> * rounds;
  double best = 0, sink = 0;
  for (int repeat = 0; repeat < 9; ++repeat) {
    const double start = omp_get_wtime();
#pragma omp parallel num_threads(threads) reduction(+ : sink)
    sink += static_cast<double>(lane_sum(multiply_adds<V>(rounds)));
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
