#pragma once
#include <filesystem>

#include "undine/io/run_record.hpp"

namespace undine {

/// All that a page shows of a study (a folder with study.json). Members are given `report`, the place of their report
/// relative to the folder, or null where they left nothing to report on. Throws InputError.
Json study_data(const std::filesystem::path& folder);

/// The folders of the members that lie in the study's folder and hold a run.
std::vector<std::filesystem::path> study_members(const std::filesystem::path& folder);

}  // namespace undine
