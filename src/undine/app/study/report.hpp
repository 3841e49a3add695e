#pragma once
#include <filesystem>
#include <string>

#include "undine/app/study/table.hpp"
#include "undine/io/run_record.hpp"

namespace undine::study {

/// Writes results.csv, study.md and study.json into the folder, each whole or not at all. Throws Error.
void write_report(const StudyFile& study, const std::vector<Member>& members, const std::filesystem::path& folder);

/// A line of the scored table, with metric, value, limit, bound, pass, unit and source.
Json score_json(const Score& score);

/// The same as a row of a markdown table, with the study's name before it.
std::string score_row(const std::string& name, const Score& score);

}  // namespace undine::study
