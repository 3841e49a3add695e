#pragma once
#include "undine/app/report/blocks.hpp"
#include "undine/app/run/folder.hpp"

namespace undine {

/// The run's record, tables and gauges for a page; their numbers in blocks.
Json run_series(const RunFolder& run, Blocks& blocks);

/// All that a page shows of a run, in about `bytes`; its numbers in blocks.
Json run_data(const RunFolder& run, std::size_t bytes, Blocks& blocks);

}  // namespace undine
