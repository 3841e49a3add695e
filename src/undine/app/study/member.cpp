#include "undine/app/study/member.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/app/approximate/study.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/checksum.hpp"
#include "undine/io/run_record.hpp"

namespace undine::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_file = "member.json";

/// A name for a folder: values joined, other signs replaced.
std::string folder_name(const StudyFile& study, const Choice& choice) {
  std::string name;
  for (std::size_t a = 0; a < choice.size(); ++a) name += (a ? "," : "") + study.axes[a].values[choice[a]].name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view("_-.,+=").find(c) == std::string_view::npos)
      c = '_';
  return name.empty() || name[0] == '.' ? "case" + name : name;
}

/// The newest snapshot of a finished run.
fs::path last_snapshot(const Member& member) {
  const Json series = read_json(member.folder / "particles.vtkhdf.series");
  return fs::absolute(member.folder / series.at("files").back().at("name").get<std::string>());
}

RunOptions run_options(const Member& member, const std::vector<Member>& all) {
  RunOptions options{.file = member.base, .sets = {}, .out = member.folder};
  for (const Table::Literal& each : member.set) options.sets.push_back(each.path + "=" + each.text);
  if (!member.parent) return options;
  if (const auto dot = member.into.rfind('.'); dot != std::string::npos)
    options.sets.push_back(member.into.substr(0, dot) + ".shape=");  // a body has a list or a shape
  options.sets.push_back(fmt::format("{}='{}'", member.into, last_snapshot(all[*member.parent]).string()));
  return options;
}

/// An error about an override is about the line of the study that gave it.
[[noreturn]] void rethrow_in_study(const InputError& error, const Member& member) {
  auto parts = error.parts();
  for (auto each = member.set.rbegin(); each != member.set.rend(); ++each)
    if (parts.where.file == "--set " + each->path && !each->where.file.empty()) {
      parts.where = each->where;
      throw InputError(std::move(parts));
    }
  throw error;
}

/// Whether an override of this member is at fault, rather than its case.
bool blames_override(const InputError& error) { return error.parts().where.file.starts_with("--set "); }

}  // namespace

const char* word(Status status) {
  switch (status) {
    case Status::waiting:
      return "not run";
    case Status::running:
      return "running";
    case Status::finished:
      return "finished";
    case Status::went_bad:
      return "went bad";
    case Status::failed:
      return "failed";
    case Status::interrupted:
      return "interrupted";
  }
  return "";
}

std::vector<Member> make_members(const StudyFile& study, const fs::path& out, const std::vector<std::string>& sets) {
  std::vector<Member> members;
  std::set<std::string> names;
  for (const Choice& choice : study.members) {
    Member member{.name = folder_name(study, choice),
                  .choice = choice,
                  .base = study.base,
                  .set = study.set,
                  .folder = {},
                  .parent = {},
                  .into = {},
                  .measures_consistency = study.measures_consistency,
                  .outline = {},
                  .key = {},
                  .error = {}};
    while (!names.insert(member.name).second) member.name += "_";
    member.folder = out / member.name;
    for (std::size_t a = 0; a < choice.size(); ++a) {
      const AxisValue& value = study.axes[a].values[choice[a]];
      if (!value.base.empty()) member.base = value.base;
      member.set.insert(member.set.end(), value.set.begin(), value.set.end());
    }
    if (member.base.empty() && !study.measures_consistency)
      throw InputError({.what = fmt::format("'{}' has no case to run", member.name),
                        .where = {study.file.string()},
                        .fix = "add case = \"case.toml\" at the top of the file, or to a value of an axis"});
    member.set.insert(member.set.end(), study.quick_set.begin(), study.quick_set.end());
    for (const std::string& each : sets) {
      const auto equals = each.find('=');
      if (equals == std::string::npos)
        throw InputError({.what = "an override needs a key and a value",
                          .where = {"--set " + each},
                          .fix = "write --set key=value"});
      member.set.push_back({each.substr(0, equals), each.substr(equals + 1), {}});
    }
    members.push_back(std::move(member));
  }
  for (Member& member : members)
    for (std::size_t a = 0; a < member.choice.size(); ++a) {
      const auto& values = study.axes[a].values;
      const AxisValue& value = values[member.choice[a]];
      if (value.from.empty()) continue;
      Choice before = member.choice;
      before[a] = static_cast<std::size_t>(std::ranges::find(values, value.from, &AxisValue::name) - values.begin());
      const auto parent = std::ranges::find(members, before, &Member::choice);
      if (parent == members.end())
        throw InputError(
            {.what = fmt::format("'{}' starts from a member that this study does not have", member.name),
             .where = {study.file.string()},
             .why = fmt::format("value '{}' of axis '{}' starts from '{}'", value.name, study.axes[a].name, value.from),
             .fix = "list that member as well"});
      member.parent = static_cast<std::size_t>(parent - members.begin());
      member.into = value.into;
    }
  return members;
}

bool resolvable(const Member& member, const std::vector<Member>& all) {
  return !member.parent || (all[*member.parent].status == Status::finished &&
                            fs::exists(all[*member.parent].folder / "particles.vtkhdf.series"));
}

void resolve(Member& member, const std::vector<Member>& all) {
  try {
    const RunOptions options = run_options(member, all);
    member.outline = member.measures_consistency ? outline_consistency(options.sets) : outline_case(options);
  } catch (const InputError& error) {
    if (blames_override(error)) rethrow_in_study(error, member);
    member.status = Status::failed;
    member.error = error.what();
    return;
  }
  Hash64 hash;
  const std::string identity = fmt::format("{} {} {}{}", program_version(), member.outline->hash,
                                           member.parent ? all[*member.parent].key : std::string(), member.maker);
  hash.add_values(std::span<const char>(identity));
  member.key = hash.text();
  if (!fs::exists(member.folder / record_file)) return;
  const Json record = read_json(member.folder / record_file);
  if (record.value("key", "") != member.key) return;
  const std::string status = record.value("status", "");
  for (const Status each : {Status::finished, Status::went_bad, Status::interrupted})
    if (status == word(each)) member.status = each;
  member.error = record.value("error", "");
  read_facts(member);
}

void read_facts(Member& member) {
  if (!fs::exists(member.folder / "run.json")) return;
  const Json run = read_json(member.folder / "run.json");
  RunFacts& facts = member.facts;
  facts.time = run.at("time").get<double>();
  facts.steps = run.at("steps").get<double>();
  facts.fluid = run.at("particles").at("fluid").get<double>();
  facts.particles = facts.fluid + run.at("particles").at("wall").get<double>();
  facts.wall_time = run.at("seconds").at("total").get<double>();
  facts.rate = run.at("particle_updates_per_s").get<double>();
  facts.finished = member.status == Status::finished ? 1 : 0;
  if (member.status == Status::went_bad) facts.blow_up_time = facts.time;
}

std::vector<std::string> run_words(const Member& member, const std::vector<Member>& all, bool resume) {
  const RunOptions options = run_options(member, all);
  std::vector<std::string> words{"run", options.file.string(), "--quiet", "--no-report"};
  words.emplace_back(resume ? "--resume" : "--overwrite");
  if (member.measures_consistency) words = {"approximate", "--consistency"};
  words.insert(words.end(), {"--out", options.out.string(), "--threads", "1"});
  for (const std::string& each : options.sets) words.insert(words.end(), {"--set", each});
  return words;
}

void remember(const Member& member) {
  write_json(member.folder / record_file,
             Json{{"key", member.key}, {"status", word(member.status)}, {"error", member.error}});
}

}  // namespace undine::study
