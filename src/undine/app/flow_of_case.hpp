#pragma once
#include <memory>

#include "undine/app/case_setup.hpp"
#include "undine/io/checkpoint.hpp"
#include "undine/schemes/flow.hpp"

namespace undine {

/// The flow of a case before its `start`, which takes the set-up's particles; or the one that a checkpoint left, which
/// goes on with the same bits.
template <int N>
std::unique_ptr<Flow<N>> flow_of_case(CaseSetup<N>& setup, const OwnedCheckpoint* checkpoint);

/// What the limits allow, or less where the error of the last step asks for it.
template <int N>
Step next_step(Flow<N>& flow, const SchemeChoice& choice);

/// One step of the case's integrator.
template <int N>
void take_step(Flow<N>& flow, const SchemeChoice& choice, double dt);

}  // namespace undine
