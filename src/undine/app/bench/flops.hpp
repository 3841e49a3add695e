#pragma once
#include "undine/backend/backend.hpp"
#include "undine/engine/store.hpp"

namespace undine {

/// Additions, subtractions, multiplications, divisions and square roots that the force pass of the bench makes for one
/// pair, counted by running the terms themselves on numbers that count. Comparisons, minima, maxima, signs and loads
/// are not counted, nor is what lanes without a pair do: the share of the peak is that of useful work.
double flops_per_pair(Group source);

/// Flops per second of independent fused multiply-adds on full packs: what this machine can do at most, measured.
double measured_fma_peak(PairPrecision precision, int threads);

/// Bytes per second of a(i) = b(i) + s c(i) on arrays far larger than the caches, 24 bytes counted for each i.
double measured_bandwidth(int threads);

}  // namespace undine
