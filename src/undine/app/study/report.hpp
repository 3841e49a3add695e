#pragma once
#include <filesystem>

#include "undine/app/study/table.hpp"

namespace undine::study {

/// Writes results.csv, study.md and study.json into the folder, each whole or not at all. Throws Error.
void write_report(const StudyFile& study, const std::vector<Member>& members, const std::filesystem::path& folder);

}  // namespace undine::study
