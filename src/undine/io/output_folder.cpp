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

/// Whether an earlier run wrote the file, and a later one might leave it behind.
bool is_output(const fs::path& file) {
  const std::string name = file.filename().string();
  constexpr std::string_view endings[] = {".vtkhdf", ".vtkhdf.series", ".checkpoint", ".refused", ".tmp"};
  return name == "report.html" || name == "diagnosis.txt" ||
         std::ranges::any_of(endings, [&](std::string_view ending) { return name.ends_with(ending); });
}

/// What a run that was killed had half written.
bool is_half_written(const fs::path& file) { return file.extension() == ".tmp"; }

void remove_files(const fs::path& folder, bool (*goes)(const fs::path& file)) {
  std::error_code reason;
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, reason))
    if (entry.is_regular_file(reason) && goes(entry.path())) old.push_back(entry.path());
  for (const fs::path& file : old)
    if (!fs::remove(file, reason) && reason) refuse_access(folder, reason);
}

/// Writes the marker; fails if it is there already, unless that is fine.
void mark(const fs::path& folder, FolderMode mode) {
  const int once = mode == FolderMode::fresh ? O_EXCL : 0;
  const int descriptor = ::open((folder / marker).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | once, 0666);
  if (descriptor < 0 && errno == EEXIST)
    refuse(folder, "another run has just begun to write to it", "choose another folder with --out");
  if (descriptor < 0) refuse_access(folder, {errno, std::generic_category()});
  ::close(descriptor);
}

}  // namespace

void prepare_output_folder(const fs::path& folder, FolderMode mode) {
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
  if (mode == FolderMode::resume) remove_files(folder, is_half_written);
  if (mode == FolderMode::overwrite) {
    remove_files(folder, is_output);
    if (fs::exists(folder / "window", reason)) remove_files(folder / "window", is_output);
  }
  mark(folder, mode);
}

}  // namespace undine
