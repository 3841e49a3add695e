#pragma once
#include <string>
#include <vector>

#include "undine/app/approximate/approximate.hpp"
#include "undine/app/case_outline.hpp"

namespace undine {

/// `undine approximate --consistency`: prints what the methods make of polynomials and of a smooth function, and with
/// `out` writes that of one method into the folder, as a run does: run.json and gauges/*.csv. docs/approximation.md
/// says what the columns mean. Keys of `sets`: method, order, dimensions, kernel, support, jitter, queries, seed.
int run_consistency(const ApproximateOptions& options);

/// What a study must know of it before it begins. Throws InputError.
CaseOutline outline_consistency(const std::vector<std::string>& sets);

}  // namespace undine
