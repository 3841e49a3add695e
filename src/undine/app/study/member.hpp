#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "undine/app/case_outline.hpp"
#include "undine/app/study/study_file.hpp"

namespace undine::study {

enum class Status {
  waiting,  ///< not run, or not chosen by --only
  running,
  finished,  ///< reached its end
  went_bad,  ///< exit 3: not finite, escaped, collapsed
  failed,    ///< the case was refused, or the program died
  interrupted
};
const char* word(Status status);

/// One run of a study.
struct Member {
  std::string name = {};
  Choice choice = {};
  std::filesystem::path base = {};       ///< case file
  std::vector<Table::Literal> set = {};  ///< in order
  std::filesystem::path folder = {};
  std::optional<std::size_t> parent = {};  ///< member whose last particles it starts from
  std::string into = {};                   ///< key that takes their file
  bool measures_consistency = false;       ///< no run of a case, but `undine approximate --consistency`
  std::string maker = {};                  ///< joins the key
  bool chosen = true;

  std::optional<CaseOutline> outline = {};
  std::string key = {};  ///< hash of the resolved case, of its parents' too
  Status status = Status::waiting;
  std::string error = {};
  RunFacts facts = {};

  /// Whether there is something to measure; an interrupted run has not said its last.
  bool measured() const { return outline && status != Status::waiting && status != Status::running; }
  /// Whether running it again would give the same.
  bool done() const { return status == Status::finished || status == Status::went_bad; }
};

/// The members of a study, with their folders below `out`. `sets` ("key=value") come last.
std::vector<Member> make_members(const StudyFile& study, const std::filesystem::path& out,
                                 const std::vector<std::string>& sets);

/// Reads the member's case, and what an earlier run of the same case left. A mistake in the study file is thrown, at
/// its place there; what a case refuses by itself is the member's error.
void resolve(Member& member, const std::vector<Member>& all);

/// Whether the case can be read now: the particles that it starts from are there.
bool resolvable(const Member& member, const std::vector<Member>& all);

/// Reads run.json of the member's folder into `facts`.
void read_facts(Member& member);

/// Words of the command line after "undine": the command, the case, its overrides, the folder.
std::vector<std::string> run_words(const Member& member, const std::vector<Member>& all, bool resume);

/// Keeps the outcome in the folder, for a later study to find.
void remember(const Member& member);

}  // namespace undine::study
