#pragma once
#include "undine/app/report/blocks.hpp"
#include "undine/app/run_folder.hpp"

namespace undine {

/// All that a page shows of a run, in about `bytes`; its numbers in blocks.
Json run_data(const RunFolder& run, std::size_t bytes, Blocks& blocks);

}  // namespace undine
