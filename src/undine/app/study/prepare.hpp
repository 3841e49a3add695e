#pragma once
#include <filesystem>
#include <vector>

#include "undine/app/study/member.hpp"
#include "undine/app/study/runner.hpp"
#include "undine/app/study/study.hpp"
#include "undine/app/study/study_file.hpp"

namespace undine::study {

/// A study that can begin: its file, and its members with what earlier runs left of them.
struct Prepared {
  StudyFile file;
  std::filesystem::path out;
  std::vector<Member> members;
};

/// Reads the study and every member's case. Throws InputError at the place in the file that is wrong.
Prepared prepare(const StudyOptions& options);

/// `jobs` members at a time (0: one per core) within most of the memory that is free.
RunnerOptions runner_options(int jobs);

/// Pairs per second of one core, by the members that have run.
double pair_rate(const std::vector<Member>& members);
/// Seconds that a member takes at that rate, from its start.
double estimate(const Member& member, double rate);

}  // namespace undine::study
