#pragma once
#include <memory>

#include "undine/app/case_setup.hpp"
#include "undine/io/checkpoint.hpp"
#include "undine/schemes/flow.hpp"

namespace undine {

/// The flow that a case starts, which takes the set-up's particles; or the one that a checkpoint left.
template <int N>
std::unique_ptr<Flow<N>> make_flow(CaseSetup<N>& setup, const OwnedCheckpoint* checkpoint);

/// One step of the case's integrator.
template <int N>
void take_step(Flow<N>& flow, const SchemeChoice& choice, double dt);

}  // namespace undine
