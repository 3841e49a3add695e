#include "undine/io/atomic_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int reason) {
  const bool full = reason == ENOSPC || reason == EDQUOT || reason == EFBIG;
  throw Error({.what = fmt::format("cannot write '{}'", path.string()),
               .why = std::generic_category().message(reason),
               .fix = full ? "free some space, or write to another folder with --out"
                           : "check that the folder exists and that you may write to it"});
}

/// Forces a file or a folder to the disk; 0 or an errno.
int sync(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  if (descriptor < 0) return errno;
  int reason = ::fsync(descriptor) == 0 ? 0 : errno;
  if (reason == EINVAL || reason == EROFS) reason = 0;  // a file system that has no such thing
  ::close(descriptor);
  return reason;
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)), temporary_(target_) { temporary_ += ".tmp"; }

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
  if (const int reason = sync(temporary_, O_RDONLY); reason != 0) fail(target_, reason);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(target_, errno);
  committed_ = true;
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  sync(folder, O_RDONLY | O_DIRECTORY);  // best effort: the name is already there for every reader
}

void write_text_atomically(const fs::path& path, const std::string& text) {
  AtomicFile file(path);
  const int descriptor = ::open(file.temporary().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(path, errno);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(descriptor, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int reason = errno;
      ::close(descriptor);
      fail(path, reason);
    }
    done += static_cast<std::size_t>(count);
  }
  if (::close(descriptor) != 0) fail(path, errno);
  file.commit();
}

std::string read_text(const fs::path& path) {
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 30;
  const auto refuse = [&](std::string why) {
    throw InputError({.what = fmt::format("cannot read '{}'", path.string()), .why = std::move(why)});
  };
  std::error_code reason;
  if (fs::is_directory(path, reason)) refuse("it is a folder");
  if (fs::is_regular_file(path, reason) && fs::file_size(path, reason) > largest) refuse("it is larger than 1 GiB");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(std::generic_category().message(errno));
  std::string text;
  char block[1 << 16];
  while (stream.read(block, sizeof block) || stream.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest) refuse("it is larger than 1 GiB");
  }
  if (stream.bad()) refuse("reading failed part of the way");
  return text;
}

}  // namespace undine
