#include "undine/io/output_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

constexpr const char* marker = ".undine";

[[noreturn]] void refuse(const fs::path& folder, std::string why, std::string fix) {
  throw InputError({.what = fmt::format("cannot use '{}' as the output folder", folder.string()),
                    .why = std::move(why),
                    .fix = std::move(fix)});
}

[[noreturn]] void refuse_access(const fs::path& folder, std::error_code reason) {
  refuse(folder, reason.message(), "choose a folder that you may write to with --out");
}

/// Whether an earlier run wrote the file, and a later one might leave it behind, or be ended before it writes its own.
bool is_output(const fs::path& file) {
  const std::string name = file.filename().string();
  constexpr std::string_view names[] = {"report.html",   "diagnosis.txt", "run.json",
                                        "progress.json", "energies.csv",  "steps.csv"};
  constexpr std::string_view endings[] = {".vtkhdf", ".vtkhdf.series", ".checkpoint", ".refused", ".tmp"};
  return std::ranges::count(names, name) > 0 ||
         std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); });
}

bool is_series(const fs::path& file) { return file.extension() == ".csv"; }

/// What a run that goes on makes untrue: what was half written when it was killed, and why it went bad.
bool is_outlived(const fs::path& file) { return file.extension() == ".tmp" || file.filename() == "diagnosis.txt"; }

void remove_files(const fs::path& folder, bool (*goes)(const fs::path& file)) {
  std::error_code reason;
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, reason))
    if (entry.is_regular_file(reason) && goes(entry.path())) old.push_back(entry.path());
  for (const fs::path& file : old)
    if (!fs::remove(file, reason) && reason) refuse_access(folder, reason);
}

/// Writes the marker; fails if it is there already, unless that is fine. Returns it, open.
int mark(const fs::path& folder, FolderMode mode) {
  const int once = mode == FolderMode::fresh ? O_EXCL : 0;
  const int descriptor = ::open((folder / marker).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | once, 0666);
  if (descriptor < 0 && errno == EEXIST)
    refuse(folder, "another run has just begun to write to it", "choose another folder with --out");
  if (descriptor < 0) refuse_access(folder, {errno, std::generic_category()});
  return descriptor;
}

void lock(int descriptor, const fs::path& folder) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno != EWOULDBLOCK) return;  // a file system without locks
    refuse(folder, "another run is writing to it", "wait for its end, stop it, or choose another folder with --out");
  }
}

}  // namespace

FolderClaim::~FolderClaim() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderClaim FolderClaim::of(const fs::path& folder) {
  FolderClaim claim(::open((folder / marker).c_str(), O_WRONLY | O_CLOEXEC));
  if (claim.descriptor_ >= 0) lock(claim.descriptor_, folder);
  return claim;
}

FolderClaim prepare_output_folder(const fs::path& folder, FolderMode mode, FolderClaim claim) {
  if (folder.empty()) refuse(folder, "it has no name", "name a folder with --out");
  std::error_code reason;
  const fs::file_status status = fs::status(folder, reason);
  if (fs::exists(status) && !fs::is_directory(status))
    refuse(folder, "it is a file", "choose another folder with --out, or remove the file");
  if (!fs::exists(status)) {
    if (mode == FolderMode::resume)
      refuse(folder, "it does not exist, so there is no run to resume", "start the run without --resume");
    fs::create_directories(folder, reason);
    if (reason) refuse_access(folder, reason);
  }
  const bool empty = fs::is_empty(folder, reason);
  if (reason) refuse_access(folder, reason);
  if (mode == FolderMode::fresh && !empty)
    refuse(folder, "it is not empty",
           "choose another folder with --out, continue its run with --resume, or replace it with --overwrite");
  if (mode == FolderMode::resume && empty)
    refuse(folder, "it is empty, so there is no run to resume", "start the run without --resume");
  if (mode == FolderMode::overwrite && !empty && !fs::exists(folder / marker, reason))
    refuse(folder, "it holds files that no run of this program put there",
           "choose another folder with --out, or empty it yourself");
  if (claim.descriptor_ < 0) {
    claim.descriptor_ = mark(folder, mode);
    lock(claim.descriptor_, folder);
  }
  if (mode == FolderMode::resume) remove_files(folder, is_outlived);
  if (mode == FolderMode::overwrite) {
    remove_files(folder, is_output);
    if (fs::is_directory(folder / "gauges", reason)) remove_files(folder / "gauges", is_series);
  }
  if (mode != FolderMode::fresh && fs::is_directory(folder / "window", reason))
    remove_files(folder / "window", is_output);
  return claim;
}

}  // namespace undine
