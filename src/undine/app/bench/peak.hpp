#pragma once
#include "undine/backend/backend.hpp"

namespace undine {

/// Flops per second of independent multiply-adds on full packs of the instruction set `Tag` (core/isa.hpp).
template <class Tag>
double fma_peak(PairPrecision precision, int threads);

}  // namespace undine
