#include "undine/app/run/checkpoints.hpp"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "undine/app/run/output.hpp"
#include "undine/core/error.hpp"
#include "undine/io/checksum.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string, std::less<>> by_key(std::string_view lines) {
  std::map<std::string, std::string, std::less<>> values;
  while (!lines.empty()) {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(lines.size(), line.size() + 1));
    const std::size_t at = line.find('=');
    if (at != line.npos) values.emplace(line.substr(0, at), line.substr(at + 1));
  }
  return values;
}

/// The first few keys that differ.
std::string differences(std::string_view written, std::string_view wanted) {
  const auto was = by_key(written), is = by_key(wanted);
  std::vector<std::string> found;
  for (const auto& [key, value] : was) {
    const auto now = is.find(key);
    if (now == is.end())
      found.push_back(fmt::format("{} is not there any more", key));
    else if (now->second != value)
      found.push_back(fmt::format("{} was {}, is {}", key, value, now->second));
  }
  for (const auto& [key, value] : is)
    if (!was.contains(key)) found.push_back(fmt::format("{} = {} is new", key, value));
  constexpr std::size_t most = 3;
  const std::size_t more = found.size() > most ? found.size() - most : 0;
  found.resize(std::min(found.size(), most));
  return fmt::format("{}{}", fmt::join(found, ", "), more ? fmt::format(" and {} more", more) : "");
}

}  // namespace

std::string fitting_keys(const Document& document) {
  std::string lines;
  for (const auto& [key, value] : document.resolved()) {
    if (key.starts_with("output") || key.starts_with("gauge") || key.starts_with("watchdog") || key == "time.end" ||
        key == "time.largest_step" || key == "title")
      continue;
    lines += key + "=" + value + "\n";
  }
  return lines;
}

std::string case_hash(const Document& document) {
  Hash64 hash;
  const std::string keys = fitting_keys(document);
  hash.add_values(std::span<const char>(keys));
  return hash.text();
}

std::string rounding_of(const Backend& backend) {
  const auto set = backend.kind == BackendKind::threads ? backend.instructions : InstructionSet::basic;
  return fmt::format("undine {} with {} instructions", program_version(),
                     instruction_set_names[static_cast<std::size_t>(set)]);
}

std::vector<fs::path> Checkpoints::files() const {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored))
    if (entry.path().extension() == ".checkpoint") found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

void Checkpoints::write(CheckpointData data) const {
  data.state.texts["case"] = hash_;
  data.state.texts["keys"] = keys_;
  data.state.texts["rounding"] = rounding_;
  write_checkpoint(folder_ / fmt::format("step_{:012}.checkpoint", data.frame.step), data);
  const auto all = files();
  std::error_code ignored;  // one too many does no harm
  for (std::size_t k = 0; k + 2 < all.size(); ++k) fs::remove(all[k], ignored);
}

/// Why a whole checkpoint does not belong to this case; empty where it does.
std::string Checkpoints::misfit(const OwnedCheckpoint& checkpoint) const {
  const auto& texts = checkpoint.state.texts;
  const auto hash = texts.find("case");
  if (hash != texts.end() && hash->second == hash_) return {};
  const auto keys = texts.find("keys");
  return keys == texts.end() ? "it belongs to another case"
                             : "it belongs to another case: " + differences(keys->second, keys_);
}

FoundCheckpoint Checkpoints::read_newest() const {
  const auto all = files();
  FoundCheckpoint found;
  for (auto file = all.rbegin(); file != all.rend(); ++file) {
    std::string reason;
    try {
      found.checkpoint = read_checkpoint(*file);
      found.file = *file;
      reason = misfit(found.checkpoint);
      if (reason.empty()) {
        const auto& texts = found.checkpoint.state.texts;
        if (const auto by = texts.find("rounding"); by != texts.end()) found.rounding = by->second;
        return found;
      }
    } catch (const InputError& error) {
      reason = error.parts().why;
    }
    found.refused.push_back(fmt::format("{}: {}", file->filename().string(), reason));
  }
  const bool none = found.refused.empty();
  throw InputError({.what = none ? "there is no checkpoint to resume from" : "no checkpoint can be resumed from",
                    .where = {folder_.string()},
                    .why = fmt::format("{}", fmt::join(found.refused, "; ")),
                    .fix = none ? "run without --resume, or name the folder of an interrupted run with --out"
                                : "use the case file and --set words that the run began with, or run it again with "
                                  "--overwrite"});
}

bool Checkpoints::began_without() const {
  std::error_code ignored;
  return files().empty() && fs::exists(folder_ / ".undine", ignored);
}

void Checkpoints::set_aside_newer_than(const fs::path& file) const {
  for (const fs::path& each : files()) {
    if (each <= file) continue;
    fs::path aside = each;
    aside += ".refused";
    std::error_code ignored;
    fs::rename(each, aside, ignored);
  }
}

bool CheckpointClock::due(double before, double now) const {
  if (undine::due(simulated_, before, now)) return true;
  return wall_ > 0 && std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count() >= wall_;
}

template <int N>
Store<N> store_from(const OwnedFrame& frame) {
  Store<N> store;
  FieldSet fields;
  for (int f = 0; f < FieldId::count; ++f)
    if (frame.find(all_fields[f].name)) fields.set(f);
  store.allocate(fields);
  const auto* groups = frame.find_integers("group");
  const auto* ids = frame.find_integers(identity_column);
  const auto* materials = frame.find_integers("material");
  std::size_t walls = 0;
  for (std::size_t i = 0; i < frame.particles; ++i) walls += groups->at(i) == 1;
  store.append(Group::fluid, frame.particles - walls, 0);
  store.append(Group::wall, walls, 0);
  for (std::size_t i = 0; i < frame.particles; ++i) {
    store.ids()[i] = ids->at(i);
    store.materials()[i] = static_cast<std::int32_t>(materials->at(i));
  }
  for (int f = 0; f < FieldId::count; ++f)
    if (const auto* column = frame.find(all_fields[f].name)) std::ranges::copy(column->data, store.raw(f).begin());
  return store;
}

template Store<1> store_from<1>(const OwnedFrame&);
template Store<2> store_from<2>(const OwnedFrame&);
template Store<3> store_from<3>(const OwnedFrame&);

}  // namespace undine
