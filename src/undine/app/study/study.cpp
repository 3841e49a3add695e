#include "undine/app/study/study.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <fnmatch.h>
#include <nlohmann/json.hpp>

#include "undine/app/run_options.hpp"
#include "undine/app/study/report.hpp"
#include "undine/app/study/runner.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/output_folder.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

using namespace study;
namespace fs = std::filesystem;

constexpr double pairs_per_second = 25e6;  ///< of one core, where no member of the study has run yet
constexpr double memory_share = 0.8;       ///< of what is free, for all members together

void choose(std::vector<Member>& members, const std::string& pattern) {
  if (pattern.empty()) return;
  std::vector<std::string> names;
  for (Member& member : members) {
    names.push_back(member.name);
    member.chosen = fnmatch(pattern.c_str(), member.name.c_str(), 0) == 0;
  }
  if (std::ranges::none_of(members, &Member::chosen))
    throw InputError({.what = fmt::format("no member is called '{}'", shortened(pattern, 60)),
                      .where = {"--only"},
                      .why = "members are " + shortened(listed(names), 600),
                      .fix = did_you_mean(pattern, names) + " * and ? stand for any letters"});
  for (bool changed = true; changed;) {  // those that chosen ones start from
    changed = false;
    for (Member& member : members)
      if (member.chosen && member.parent && !members[*member.parent].chosen)
        members[*member.parent].chosen = changed = true;
  }
}

/// Every formula of columns must fit the members that write them; a series that no member writes is a mistake.
void check_series(const StudyFile& file, const std::vector<Member>& members) {
  const bool all_known = std::ranges::all_of(members, [](const Member& m) { return m.outline.has_value(); });
  for (const study::Quantity& quantity : file.quantities) {
    if (quantity.series.empty()) continue;
    bool found = false;
    std::set<std::string> names;
    for (const Member& member : members) {
      if (!member.outline) continue;
      for (const auto& [name, columns] : member.outline->series) {
        names.insert(name);
        if (name != quantity.series) continue;
        check_columns(quantity, columns);
        found = true;
      }
    }
    const std::vector<std::string> valid(names.begin(), names.end());
    if (!found && all_known)
      quantity.table.fail("gauge", fmt::format("no member has a gauge '{}'", quantity.series),
                          "what members write: " + listed(valid), did_you_mean(quantity.series, valid));
  }
}

/// Seconds that a member takes on one core.
double estimate(const Member& member, double rate) {
  return member.outline ? member.outline->pairs() / rate : std::nan("");
}

double measured_rate(const std::vector<Member>& members) {
  double pairs = 0, seconds = 0;
  for (const Member& member : members) {
    if (!member.outline || member.facts.steps < 1 || member.facts.wall_time < 1) continue;
    pairs += member.outline->pairs() * member.facts.steps / member.outline->steps();
    seconds += member.facts.wall_time;
  }
  return seconds > 0 ? pairs / seconds : pairs_per_second;
}

void print_plan(const std::vector<Member>& members) {
  const double rate = measured_rate(members);
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
      fmt::print("{}\n", to_line(line));
    } else if (ended) {
      fmt::print("[{}/{}] {}: {} after {:.1f} s{}\n", ended_, total_, member.name, word(member.status),
                 member.facts.wall_time, member.error.empty() ? "" : ": " + shortened(member.error, 300));
    } else {
      fmt::print("        {}: started\n", member.name);
    }
    std::fflush(stdout);
  }

 private:
  const StudyOptions& options_;
  std::size_t total_ = 0, ended_ = 0;
};

}  // namespace

namespace {

/// Members start from others in any order of the file.
void resolve_all(std::vector<Member>& members) {
  for (bool more = true; more;) {
    more = false;
    for (Member& member : members)
      if (!member.outline && member.status != Status::failed && resolvable(member, members)) {
        resolve(member, members);
        more = true;
      }
  }
}

}  // namespace

int run_study(const StudyOptions& options) {
  const Document document = Document::load(options.file);
  StudyFile file = read_study(document, options.file, options.quick);
  file.command = "undine study " + options.file.filename().string() + (options.quick ? " --quick" : "");
  for (const std::string& each : options.sets) file.command += fmt::format(" --set \"{}\"", each);
  const fs::path out = options.out.empty()
                           ? fs::path("out") / (options.file.stem().string() + (options.quick ? "-quick" : ""))
                           : options.out;
  std::vector<Member> members = make_members(file, out, options.sets);
  choose(members, options.only);
  resolve_all(members);
  check_series(file, members);
  document.finish();
  if (options.again)
    for (Member& member : members)
      if (member.chosen && member.status != Status::failed) member.status = Status::waiting;
  if (options.dry_run) {
    print_plan(members);
    return exit_ok;
  }

  prepare_output_folder(out, FolderMode::overwrite);
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const RunnerOptions runner{options.jobs > 0 ? options.jobs : cores, memory_share * available_memory()};
  Progress progress(options, members);
  for (const Member& member : members)
    if (member.chosen && member.status == Status::failed) progress(member);
  const bool complete = run_members(members, runner, [&](const Member& member) {
    progress(member);
    if (member.status != Status::running) write_report(file, members, out);
  });
  write_report(file, members, out);
  if (!options.json) fmt::print("table in {}\n", (out / "study.md").string());
  return complete ? exit_ok : exit_interrupted;
}

}  // namespace undine
