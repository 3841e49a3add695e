#pragma once
#include <map>
#include <string>

#include "undine/app/case_setup.hpp"
#include "undine/app/watchdog/evidence.hpp"
#include "undine/schemes/flow.hpp"

namespace undine {

/// What the case says, and the state it starts with. The set-up must still have its particles.
template <int N>
void collect_case(Evidence& evidence, const CaseSetup<N>& setup, const std::map<std::string, std::string>& resolved);

/// Whether a state got as far as its rates, without which no term can be asked for its part.
enum class Rates { known, missing };

/// A state in which all is finite, or the best there is: the particle's numbers and what acts on it, and what all of
/// them do.
template <int N>
void collect_state(Evidence& evidence, const Flow<N>& flow, const CaseSetup<N>& setup, Rates rates);

/// The state that the alarm was for: where the particle is, if it left.
template <int N>
void collect_exit(Evidence& evidence, const Flow<N>& flow, const CaseSetup<N>& setup);

/// Of the particles that are not finite in one state, the one that most acted on in the state before: others may have
/// caught it from that one. -1 where all are finite.
template <int N>
std::int64_t first_not_finite(const Flow<N>& bad, const Flow<N>& before);

}  // namespace undine
