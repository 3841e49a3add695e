#include "undine/app/view/view_data.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "undine/app/report/blocks.hpp"
#include "undine/app/report/particles.hpp"
#include "undine/app/report/run_data.hpp"
#include "undine/app/run/control.hpp"
#include "undine/core/error.hpp"
#include "undine/io/snapshot.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

std::string with_blocks(Json data, const Blocks& blocks) {
  data["blocks"] = blocks.infos();
  data["texts"] = blocks.texts();
  return to_line(data);
}

Json times_of(const RunFolder& run) {
  Json times = Json::array();
  for (const StoredTime& frame : run.frames) times.push_back(frame.time);
  return times;
}

/// Times without their particles, which are sent when asked for.
Json times_json(const RunFolder& run) {
  Json frames = Json::array();
  for (const StoredTime& stored : run.frames)
    frames.push_back({{"time", stored.time}, {"step", 0}, {"parts", Json::array()}, {"ranges", Json::object()}});
  return frames;
}

/// What the run last said of its progress; null where it says nothing.
Json progress_of(const fs::path& folder) {
  const fs::path file = folder / "progress.json";
  return fs::is_regular_file(file) ? read_json(file) : Json(nullptr);
}

/// Whether the run goes on and was started with --control.
bool listens(const RunFolder& run, const Json& progress) {
  return run.record.value("status", "") == "running" && progress.is_object() && progress.value("control", false);
}

}  // namespace

ViewData::ViewData(fs::path folder) : folder_(std::move(folder)) { RunFolder::open(folder_); }

const OwnedFrame& ViewData::read(const RunFolder& run, std::size_t number) const {
  const StoredTime& stored = run.frames[number];
  if (stored.file != kept_stored_.file || stored.time != kept_stored_.time) {
    kept_stored_ = {};
    kept_ = read_snapshot(stored.file);
    kept_stored_ = stored;
  }
  return kept_;
}

/// Bounds and fields are those of the first time that somebody asked; only the times grow.
Json ViewData::header(const RunFolder& run) const {
  if (run.frames.empty()) return nullptr;
  if (header_.is_null()) header_ = particles_header(run, read(run, 0));
  Json now = header_;
  now["frames_stored"] = run.frames.size();
  now["frames"] = times_json(run);
  return now;
}

std::string ViewData::all() const {
  const std::lock_guard lock(reading_);
  const RunFolder run = RunFolder::open(folder_);
  Blocks blocks;
  Json data = run_series(run, blocks);
  data["particles"] = header(run);
  data["notes"] = Json::array();
  data["progress"] = progress_of(folder_);
  return with_blocks(std::move(data), blocks);
}

std::string ViewData::state(bool may_control) const {
  const std::lock_guard lock(reading_);
  const RunFolder run = RunFolder::open(folder_);
  const Json progress = progress_of(folder_);
  return to_line(Json{{"status", run.record.value("status", "")},
                      {"times", times_of(run)},
                      {"progress", progress},
                      {"control", may_control && listens(run, progress)}});
}

bool ViewData::send(std::string_view wish) const {
  return listens(RunFolder::open(folder_), progress_of(folder_)) && send_run_wish(folder_, wish);
}

std::string ViewData::frame(std::size_t number, std::size_t most) const {
  const std::lock_guard lock(reading_);
  const RunFolder run = RunFolder::open(folder_);
  if (number >= run.frames.size())
    throw InputError({.what = fmt::format("there is no snapshot {}", number),
                      .why = fmt::format("the run has {}", run.frames.size())});
  const OwnedFrame& frame = read(run, number);
  Thinning thin{.frames = 1};
  if (frame.particles > most) thin.share = static_cast<double>(most) / static_cast<double>(frame.particles);
  Blocks blocks;
  return with_blocks({{"frame", frame_json(frame, run.frames[number].time, thin, blocks)}}, blocks);
}

}  // namespace undine
