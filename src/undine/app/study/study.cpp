#include "undine/app/study/study.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/app/run/options.hpp"
#include "undine/app/study/prepare.hpp"
#include "undine/app/study/report.hpp"
#include "undine/app/study/runner.hpp"
#include "undine/app/tell.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/output_folder.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

using namespace study;

void print_plan(const std::vector<Member>& members) {
  const double rate = pair_rate(members);
  double total = 0;
  fmt::print("{:<40} {:>11} {:>10} {:>10} {:>9} {:>8}  {}\n", "member", "status", "particles", "steps", "seconds", "MB",
             "");
  for (const Member& member : members) {
    if (!member.chosen) continue;
    const std::string after = member.parent ? "after " + members[*member.parent].name : std::string();
    if (!member.outline) {
      fmt::print("{:<40} {:>11} {:>10} {:>10} {:>9} {:>8}  {}\n", member.name, word(member.status), "-", "-", "-", "-",
                 member.error.empty() ? after : member.error);
      continue;
    }
    const CaseOutline& outline = *member.outline;
    const double seconds = member.done() ? 0 : estimate(member, rate);
    total += seconds;
    fmt::print("{:<40} {:>11} {:>10.0f} {:>10.0f} {:>9.0f} {:>8.0f}  {}\n", member.name, word(member.status),
               outline.particles(), outline.steps(), seconds, outline.memory() * 1e-6, after);
  }
  fmt::print("about {:.0f} s on one core\n", total);
}

class Progress {
 public:
  Progress(const StudyOptions& options, const std::vector<Member>& members) : options_(options) {
    total_ =
        static_cast<std::size_t>(std::ranges::count_if(members, [](const Member& m) { return m.chosen && !m.done(); }));
  }

  void operator()(const Member& member) {
    const bool ended = member.status != Status::running;
    if (ended) ++ended_;
    if (options_.json) {
      const Json line{{"member", member.name},
                      {"status", word(member.status)},
                      {"seconds", member.facts.wall_time},
                      {"error", member.error},
                      {"ended", ended_},
                      {"of", total_}};
      tell(stdout, "{}\n", to_line(line));
    } else if (ended) {
      tell(stdout, "[{}/{}] {}: {} after {:.1f} s{}\n", ended_, total_, member.name, word(member.status),
           member.facts.wall_time, member.error.empty() ? "" : ": " + shortened(member.error, 300));
    } else {
      tell(stdout, "        {}: started\n", member.name);
    }
    std::fflush(stdout);
  }

 private:
  const StudyOptions& options_;
  std::size_t total_ = 0, ended_ = 0;
};

}  // namespace

int run_study(const StudyOptions& options) {
  Prepared study = prepare(options);
  std::vector<Member>& members = study.members;
  if (options.dry_run) {
    print_plan(members);
    return exit_ok;
  }

  const FolderClaim claim = prepare_output_folder(study.out, FolderMode::overwrite);
  Progress progress(options, members);
  for (const Member& member : members)
    if (member.chosen && member.status == Status::failed) progress(member);
  const bool complete = run_members(members, runner_options(options.jobs), [&](const Member& member) {
    progress(member);
    if (member.status != Status::running) write_report(study.file, members, study.out);
  });
  write_report(study.file, members, study.out);
  if (!options.json) tell(stdout, "table in {}\n", (study.out / "study.md").string());
  return complete ? exit_ok : exit_interrupted;
}

}  // namespace undine
