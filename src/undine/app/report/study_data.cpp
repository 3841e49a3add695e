#include "undine/app/report/study_data.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/core/error.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError({.what = "this is not the record of a study", .where = {file.string()}, .why = why});
}

/// study.json with the lists that the page goes through made sure of.
Json read_study(const fs::path& folder) {
  const fs::path file = folder / "study.json";
  Json study = read_json(file);
  if (!study.is_object()) refuse(file, "it is not an object");
  for (const char* name : {"axes", "quantities", "verdicts", "members", "orders"}) {
    if (!study.contains(name)) study[name] = Json::array();
    if (!study[name].is_array()) refuse(file, fmt::format("'{}' is not a list", name));
    for (const Json& entry : study[name])
      if (!entry.is_object()) refuse(file, fmt::format("'{}' holds something else than objects", name));
  }
  for (Json& axis : study["axes"])
    if (!axis.contains("values") || !axis["values"].is_array()) axis["values"] = Json::array();
  for (Json& member : study["members"])
    for (const char* name : {"axes", "quantities", "verdicts", "published", "agrees"})
      if (!member.contains(name) || !member[name].is_object()) member[name] = Json::object();
  return study;
}

/// The member's folder as a plain path below the study's; empty if it is not.
fs::path place_of(const Json& member) {
  const auto found = member.find("folder");
  if (found == member.end() || !found->is_string()) return {};
  const fs::path place = fs::path(found->get<std::string>()).lexically_normal();
  if (place.is_absolute() || place.empty() || *place.begin() == "..") return {};
  return place;
}

std::string text_of(const Json& object, const char* name, const std::string& otherwise) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

}  // namespace

std::vector<fs::path> study_members(const fs::path& folder) {
  const Json study = read_study(folder);
  std::vector<fs::path> folders;
  for (const Json& member : study["members"]) {
    const fs::path place = place_of(member);
    if (!place.empty() && fs::is_regular_file(folder / place / "run.json")) folders.push_back(folder / place);
  }
  return folders;
}

Json study_data(const fs::path& folder) {
  Json study = read_study(folder);
  for (Json& member : study["members"]) {
    const fs::path place = place_of(member);
    const bool there = !place.empty() && fs::is_regular_file(folder / place / "report.html");
    member["report"] = there ? Json((place / "report.html").generic_string()) : Json(nullptr);
  }
  const std::string title = text_of(study, "title", folder.filename().string());
  return {{"kind", "study"}, {"title", title}, {"study", std::move(study)}, {"notes", Json::array()}};
}

}  // namespace undine
