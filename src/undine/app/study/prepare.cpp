#include "undine/app/study/prepare.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <fnmatch.h>

#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"

namespace undine::study {
namespace {

namespace fs = std::filesystem;

constexpr double memory_share = 0.8;       ///< of what is free, for all members together
constexpr double pairs_per_second = 25e6;  ///< of one core, where no member of the study has run yet

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
  for (const Quantity& quantity : file.quantities) {
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

Prepared prepare(const StudyOptions& options) {
  const Document document = Document::load(options.file);
  StudyFile file = read_study(document, options.file, options.quick);
  file.command = "undine study " + options.file.filename().string() + (options.quick ? " --quick" : "");
  for (const std::string& each : options.sets) file.command += fmt::format(" --set \"{}\"", each);
  const fs::path out = options.out.empty()
                           ? fs::path("out") / (options.file.stem().string() + (options.quick ? "-quick" : ""))
                           : options.out;
  std::vector<Member> members = make_members(file, out, options.sets);
  for (Member& member : members) member.maker = options.maker;
  choose(members, options.only);
  resolve_all(members);
  check_series(file, members);
  document.finish();
  if (options.again)
    for (Member& member : members)
      if (member.chosen && member.status != Status::failed) member.status = Status::waiting;
  return {std::move(file), out, std::move(members)};
}

double estimate(const Member& member, double rate) {
  return member.outline ? member.outline->pairs() / rate : std::nan("");
}

double pair_rate(const std::vector<Member>& members) {
  double pairs = 0, seconds = 0;
  for (const Member& member : members) {
    if (!member.outline || member.facts.steps < 1 || member.facts.wall_time < 1) continue;
    pairs += member.outline->pairs() * member.facts.steps / member.outline->steps();
    seconds += member.facts.wall_time;
  }
  return seconds > 0 ? pairs / seconds : pairs_per_second;
}

RunnerOptions runner_options(int jobs) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return {jobs > 0 ? jobs : cores, memory_share * available_memory()};
}

}  // namespace undine::study
