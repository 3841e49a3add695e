#include "undine/app/picture/movie.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "undine/core/error.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

class NumberedPictures : public Movie {
 public:
  explicit NumberedPictures(fs::path folder) : folder_(std::move(folder)) {
    std::error_code reason;
    fs::create_directories(folder_, reason);
    if (reason)
      throw Error({.what = fmt::format("cannot make the folder '{}'", folder_.string()), .why = reason.message()});
  }
  void add(Canvas& picture) override { picture.write_png(folder_ / fmt::format("{:06}.png", count_++)); }
  fs::path finish() override { return folder_; }

 private:
  fs::path folder_;
  int count_ = 0;
};

/// Feeds raw pictures to ffmpeg, which is started when their size is known.
class EncodedMovie : public Movie {
 public:
  EncodedMovie(fs::path file, double rate) : file_(std::move(file)), rate_(rate) {}
  EncodedMovie(const EncodedMovie&) = delete;
  EncodedMovie& operator=(const EncodedMovie&) = delete;
  ~EncodedMovie() override {
    if (pipe_ >= 0) ::close(pipe_);
    if (process_ > 0) ::waitpid(process_, nullptr, 0);
  }

  void add(Canvas& picture) override {
    if (process_ < 0) start(picture);
    const auto& bytes = picture.bytes();
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::write(pipe_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail();
      done += static_cast<std::size_t>(count);
    }
  }

  fs::path finish() override {
    if (process_ < 0) throw Error({.what = "a movie has no pictures"});
    ::close(pipe_);
    pipe_ = -1;
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail();
    return file_;
  }

 private:
  [[noreturn]] void fail() const {
    throw Error(
        {.what = fmt::format("cannot write '{}'", file_.string()),
         .why = "ffmpeg stopped early; its words are above",
         .fix = "check that the folder exists, or give a folder's name without an ending for numbered pictures"});
  }

  void start(const Canvas& picture) {
    std::signal(SIGPIPE, SIG_IGN);  // an encoder that stops is told of by write()
    std::vector<std::string> words{"ffmpeg",
                                   "-loglevel",
                                   "error",
                                   "-y",
                                   "-f",
                                   "rawvideo",
                                   "-pix_fmt",
                                   "bgr0",
                                   "-s",
                                   fmt::format("{}x{}", picture.width(), picture.height()),
                                   "-r",
                                   fmt::format("{:g}", rate_),
                                   "-i",
                                   "-",
                                   "-c:v",
                                   "libx264",
                                   "-pix_fmt",
                                   "yuv420p",
                                   "-crf",
                                   "18",
                                   "-movflags",
                                   "+faststart",
                                   "file:" + file_.string()};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw Error({.what = "cannot start ffmpeg", .why = std::generic_category().message(errno)});
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    const int reason = ::posix_spawnp(&process_, "ffmpeg", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    pipe_ = ends[1];
    if (reason != 0) {
      process_ = -1;
      throw Error({.what = "cannot start ffmpeg", .why = std::generic_category().message(reason)});
    }
  }

  fs::path file_;
  double rate_;
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace

std::unique_ptr<Movie> encoded_movie(const fs::path& file, double frames_per_second) {
  return std::make_unique<EncodedMovie>(file, frames_per_second);
}

std::unique_ptr<Movie> numbered_pictures(const fs::path& folder) { return std::make_unique<NumberedPictures>(folder); }

bool can_encode() {
  const char* found = std::getenv("PATH");
  std::string_view rest = found ? found : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (::access((fs::path(rest.substr(0, end)) / "ffmpeg").c_str(), X_OK) == 0) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

}  // namespace undine
