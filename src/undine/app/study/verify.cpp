#include "undine/app/study/verify.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <fmt/format.h>
#include <fnmatch.h>
#include <nlohmann/json.hpp>

#include "undine/app/run/options.hpp"
#include "undine/app/study/prepare.hpp"
#include "undine/app/study/report.hpp"
#include "undine/app/tell.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/atomic_file.hpp"
#include "undine/io/checksum.hpp"
#include "undine/io/output_folder.hpp"

namespace undine {
namespace {

using namespace study;
namespace fs = std::filesystem;

/// A study with limits, as far as its file alone tells.
struct Candidate {
  fs::path file;
  std::string name, title;
  bool is_long = false, quick = false;
};

/// The same, ready to run; its members stand at `first` among all.
struct Verification {
  std::string name;
  Prepared study;
  std::size_t first = 0;
};

/// A line of the table with the study it is of.
struct Line {
  std::string name;
  Score score;
};

/// The folder of studies that came with the program: beside an installed one, or of the tree that it was built in.
fs::path shipped_studies() {
  const fs::path place = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& folder : {place / "../share/undine/studies", place / "../studies", place / "../../studies"})
    if (fs::is_directory(folder)) return folder.lexically_normal();
  throw InputError({.what = "the studies that come with the program are not where it lies",
                    .where = {place.string()},
                    .fix = "name their folder with --files"});
}

/// Tells this build from others: results of another program say nothing about this one.
std::string build_hash() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::vector<char> block(1 << 20);
  Hash64 hash;
  while (program) {
    program.read(block.data(), static_cast<std::streamsize>(block.size()));
    hash.add_values(std::span<const char>(block.data(), static_cast<std::size_t>(program.gcount())));
  }
  return hash.text();
}

std::vector<Candidate> find_candidates(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failure;
  for (const auto& entry : fs::recursive_directory_iterator(folder, failure))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  if (failure)
    throw InputError(
        {.what = "the folder of studies cannot be read", .where = {folder.string()}, .why = failure.message()});
  std::vector<Candidate> all;
  for (const fs::path& file : files) {
    const Document document = Document::load(file);
    const Table root = document.root();
    const auto limits = root.tables("limit");
    if (limits.empty()) continue;
    all.push_back({.file = file,
                   .name = file.stem().string(),
                   .title = root.text("title", ""),
                   .is_long = root.flag("long", false),
                   .quick = std::ranges::any_of(limits, [](const Table& t) { return t.flag("quick", false); })});
  }
  std::ranges::sort(all, {}, &Candidate::name);
  const auto twice = std::ranges::adjacent_find(all, {}, &Candidate::name);
  if (twice != all.end())
    throw InputError({.what = fmt::format("two studies are called '{}'", twice->name),
                      .where = {twice->file.string()},
                      .fix = "rename one of the files"});
  return all;
}

std::vector<Candidate> choose(const std::vector<Candidate>& all, const VerifyOptions& options) {
  std::vector<std::string> names;
  for (const Candidate& each : all) names.push_back(each.name);
  std::vector<bool> wanted(all.size());
  for (std::size_t k = 0; k < all.size(); ++k)
    wanted[k] = options.names.empty() && (options.list || (!all[k].is_long && (all[k].quick || !options.quick)));
  for (const std::string& pattern : options.names) {
    bool found = false;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (fnmatch(pattern.c_str(), all[k].name.c_str(), 0) != 0) continue;
      wanted[k] = found = true;
      if (options.quick && !all[k].quick)
        throw InputError({.what = fmt::format("'{}' has no limit for --quick", all[k].name),
                          .where = {all[k].file.string()},
                          .fix = "leave --quick out, or name others"});
    }
    if (!found)
      throw InputError({.what = fmt::format("there is no verification '{}'", shortened(pattern, 60)),
                        .why = "there are " + listed(names),
                        .fix = did_you_mean(pattern, names) + " * and ? stand for any letters"});
  }
  std::vector<Candidate> chosen;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (wanted[k]) chosen.push_back(all[k]);
  return chosen;
}

Verification prepare_one(const Candidate& candidate, const fs::path& out, const VerifyOptions& options,
                         const std::string& maker) {
  return {candidate.name, prepare({.file = candidate.file,
                                   .out = out / candidate.name,
                                   .sets = {},
                                   .only = {},
                                   .quick = options.quick,
                                   .again = options.again,
                                   .maker = maker})};
}

void print_list(const std::vector<Candidate>& candidates, const fs::path& out, const VerifyOptions& options,
                const std::string& maker) {
  fmt::print("{:<22} {:>7} {:>9}  {:<7} {}\n", "name", "members", "seconds", "", "title");
  for (const Candidate& candidate : candidates) {
    if (options.quick && !candidate.quick) continue;
    const auto members = prepare_one(candidate, out, options, maker).study.members;
    double seconds = 0;
    for (const Member& member : members) seconds += member.done() ? 0 : estimate(member, pair_rate(members));
    fmt::print("{:<22} {:>7} {:>9.0f}  {:<7} {}\n", candidate.name, members.size(), seconds,
               candidate.is_long ? "long"
               : candidate.quick ? "quick"
                                 : "",
               candidate.title);
  }
  fmt::print("seconds on one core to go; long: runs only if it is named; quick: --quick has a part of it\n");
}

/// All members side by side, so that they share the cores; parents are numbered anew.
std::vector<Member> gather(std::vector<Verification>& all) {
  std::vector<Member> members;
  for (Verification& each : all) {
    each.first = members.size();
    for (Member member : each.study.members) {
      if (member.parent) *member.parent += each.first;
      members.push_back(std::move(member));
    }
  }
  return members;
}

void scatter(const std::vector<Member>& members, std::vector<Verification>& all) {
  for (Verification& each : all)
    for (std::size_t k = 0; k < each.study.members.size(); ++k) {
      Member member = members[each.first + k];
      if (member.parent) *member.parent -= each.first;
      each.study.members[k] = std::move(member);
    }
}

bool run_all(std::vector<Verification>& all, int jobs) {
  std::vector<Member> members = gather(all);
  std::size_t ended = 0;
  const auto to_run =
      std::ranges::count_if(members, [](const Member& m) { return !m.done() && m.status != Status::failed; });
  const auto name_of = [&](const Member& member) {
    const auto index = static_cast<std::size_t>(&member - members.data());
    const auto after = std::ranges::upper_bound(all, index, {}, &Verification::first);
    return std::prev(after)->name + "/" + member.name;
  };
  const bool complete = run_members(members, runner_options(jobs), [&](const Member& member) {
    if (member.status == Status::running) return;
    tell(stderr, "[{}/{}] {}: {} after {:.1f} s{}\n", ++ended, to_run, name_of(member), word(member.status),
         member.facts.wall_time, member.error.empty() ? "" : ": " + shortened(member.error, 200));
  });
  scatter(members, all);
  return complete;
}

std::string text_of(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3g}", value); }

void print_table(const std::vector<Line>& lines) {
  std::size_t name = 4, metric = 6;
  for (const Line& line : lines) {
    name = std::max(name, line.name.size());
    metric = std::max(metric, line.score.metric.size());
  }
  fmt::print("{:<{}}  {:<{}}  {:>10}  {:<10}  {}\n", "case", name, "metric", metric, "value", "limit", "pass");
  for (const Line& line : lines)
    fmt::print("{:<{}}  {:<{}}  {:>10}  {:<10}  {}\n", line.name, name, line.score.metric, metric,
               text_of(line.score.value) + (line.score.unit.empty() ? "" : " " + line.score.unit),
               line.score.limit_text(), line.score.kept_text());
}

/// The same for people who read it later.
std::string markdown_of(const std::vector<Line>& lines, const VerifyOptions& options, const std::string& verdict) {
  std::string command = options.quick ? "undine verify --quick" : "undine verify";
  for (const std::string& name : options.names) command += " " + name;
  std::string text = fmt::format("# Verification\n\n`{}`, Undine {}: {}. A line without a limit is only shown.\n\n",
                                 command, program_version(), verdict);
  text += "| case | metric | value | limit | pass | source of the limit |\n|---|---|---|---|---|---|\n";
  for (const Line& line : lines) text += score_row(line.name, line.score);
  return text;
}

}  // namespace

int run_verify(const VerifyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const fs::path folder = options.files.empty() ? shipped_studies() : options.files;
  const fs::path out =
      options.out.empty() ? fs::path("out") / (options.quick ? "verify-quick" : "verify") : options.out;
  const auto chosen = choose(find_candidates(folder), options);
  const std::string maker = " by " + build_hash();
  if (options.list) {
    print_list(chosen, out, options, maker);
    return exit_ok;
  }
  if (chosen.empty())
    throw InputError(
        {.what = "nothing to verify", .where = {folder.string()}, .why = "no study there has a [[limit]]"});

  std::vector<Verification> all;
  for (const Candidate& candidate : chosen) all.push_back(prepare_one(candidate, out, options, maker));
  std::vector<FolderClaim> claims;
  claims.push_back(prepare_output_folder(out, FolderMode::overwrite));
  for (const Verification& each : all) claims.push_back(prepare_output_folder(each.study.out, FolderMode::overwrite));
  const bool complete = run_all(all, options.jobs);

  std::vector<Line> lines;
  for (const Verification& each : all) {
    const StudyFile& file = each.study.file;
    write_report(file, each.study.members, each.study.out);
    for (Score& score : judge_limits(file, each.study.members, tabulate(file, each.study.members)))
      lines.push_back({each.name, std::move(score)});
  }
  Json array = Json::array();
  std::size_t limits = 0, kept = 0;
  for (const Line& line : lines) {
    Json entry{{"case", line.name}};
    entry.update(score_json(line.score));
    array.push_back(std::move(entry));
    limits += line.score.limited();
    kept += line.score.limited() && line.score.pass();
  }
  write_json(out / "verify.json", array);
  write_text_atomically(out / "verify.md",
                        markdown_of(lines, options, fmt::format("{} of {} limits kept", kept, limits)));
  if (options.json) {
    fmt::print("{}", to_text(array));
  } else {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    print_table(lines);
    fmt::print("{} of {} limits kept in {:.0f} s; tables and runs in {}\n", kept, limits, seconds.count(),
               out.string());
  }
  return !complete ? exit_interrupted : kept == limits ? exit_ok : exit_missed;
}

}  // namespace undine
