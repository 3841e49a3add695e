#include "undine/app/study/runner.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "undine/app/run/options.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/atomic_file.hpp"
#include "undine/io/output_folder.hpp"

namespace undine::study {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_error = 2000;  // bytes of a member's message that are kept

volatile std::sig_atomic_t stop_wanted = 0;
void on_signal(int) { stop_wanted = 1; }

/// Takes SIGINT, SIGTERM and SIGHUP (not where it is ignored, as under nohup) while it lives; waiting calls then
/// return. Whoever reads what is told may go.
class SignalGuard {
 public:
  SignalGuard() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &action, &before_[k]);
    if (before_.back().sa_handler == SIG_IGN) std::signal(signals.back(), SIG_IGN);
    before_pipe_ = std::signal(SIGPIPE, SIG_IGN);
    stop_wanted = 0;
  }
  ~SignalGuard() {
    std::signal(SIGPIPE, before_pipe_);
    for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before_[k], nullptr);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, signals.size()> before_{};
  sighandler_t before_pipe_ = SIG_DFL;
};

bool has_checkpoint(const fs::path& folder) {
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure))
    if (entry.path().extension() == ".checkpoint") return true;
  return false;
}

/// The child's side between fork and exec: only calls that are safe there.
[[noreturn]] void become_run(const std::vector<char*>& words, const char* out, const char* err, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGINT);
  if (getppid() != parent) _exit(exit_internal);
  const int output = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int errors = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int input = open("/dev/null", O_RDONLY);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  execv("/proc/self/exe", words.data());
  _exit(exit_internal);
}

class Runner {
 public:
  Runner(std::vector<Member>& members, const RunnerOptions& options, const std::function<void(const Member&)>& report)
      : members_(members), options_(options), report_(report) {
    for (std::size_t k = 0; k < members.size(); ++k)
      if (members[k].chosen && !members[k].done() && members[k].status != Status::failed) waiting_.push_back(k);
  }

  bool run() {
    const SignalGuard guard;
    while (true) {
      if (!stop_wanted) start_ready();
      if (running_.empty()) break;
      wait_for_one();
    }
    return !stop_wanted;
  }

 private:
  struct Child {
    pid_t process;
    std::size_t member;
  };

  void start_ready() {
    for (std::size_t k = 0; k < waiting_.size();) {
      Member& member = members_[waiting_[k]];
      const bool parent_pending = member.parent && std::ranges::count(waiting_, *member.parent) > 0;
      const bool parent_running = member.parent && members_[*member.parent].status == Status::running;
      if (parent_pending || parent_running || !room_for(member)) {
        ++k;
        continue;
      }
      const std::size_t index = waiting_[k];
      waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(k));
      start(index);
    }
  }

  bool room_for(const Member& member) const {
    if (running_.empty()) return true;
    if (running_.size() >= static_cast<std::size_t>(options_.jobs)) return false;
    double taken = member.outline ? member.outline->memory() : 0;
    for (const Child& child : running_) taken += members_[child.member].outline->memory();
    return taken <= options_.memory;
  }

  void start(std::size_t index) {
    Member& member = members_[index];
    if (member.parent) {
      const Member& parent = members_[*member.parent];
      if (!resolvable(member, members_)) {
        fail(member,
             fmt::format("'{}', which it starts from, has no last snapshot ({})", parent.name, word(parent.status)));
        return;
      }
      try {
        resolve(member, members_);
      } catch (const Error& error) {
        fail(member, error.what());
        return;
      }
      if (member.done() || member.status == Status::failed) {
        report_(member);
        return;
      }
    }
    try {
      spawn(index);
    } catch (const Error& error) {
      fail(member, error.what());
    }
  }

  void fail(Member& member, std::string why) {
    member.status = Status::failed;
    member.error = std::move(why);
    report_(member);
  }

  void spawn(std::size_t index) {
    Member& member = members_[index];
    const bool resume = member.status == Status::interrupted && has_checkpoint(member.folder);
    // What an earlier run left would pass for this one's if it died at once. The claim is the member's own again.
    {
      const FolderClaim claim =
          prepare_output_folder(member.folder, resume ? FolderMode::resume : FolderMode::overwrite);
    }
    auto words = run_words(member, members_, resume);
    words.insert(words.begin(), "undine");
    std::vector<char*> pointers;
    for (std::string& each : words) pointers.push_back(each.data());
    pointers.push_back(nullptr);
    const std::string out = (member.folder / "log.txt").string(), err = errors_of(member).string();
    member.status = Status::interrupted;  // what a later study finds if this one is killed
    member.error.clear();
    remember(member);
    member.status = Status::running;
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process == 0) become_run(pointers, out.c_str(), err.c_str(), parent);
    if (process < 0) return fail(member, fmt::format("cannot start a process: {}", std::strerror(errno)));
    running_.push_back({process, index});
    report_(member);
  }

  static fs::path errors_of(const Member& member) { return member.folder / "errors.txt"; }

  void wait_for_one() {
    int status = 0;
    const pid_t ended = waitpid(-1, &status, 0);
    if (ended < 0) {
      if (errno != EINTR) throw Error({.what = fmt::format("waiting for members failed: {}", std::strerror(errno))});
      if (stop_wanted)
        for (const Child& child : running_) kill(child.process, SIGINT);
      return;
    }
    const auto child = std::ranges::find(running_, ended, &Child::process);
    if (child == running_.end()) return;
    Member& member = members_[child->member];
    running_.erase(child);
    conclude(member, status);
    remember(member);
    report_(member);
  }

  static void conclude(Member& member, int status) {
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    member.status = code == exit_ok            ? Status::finished
                    : code == exit_run         ? Status::went_bad
                    : code == exit_interrupted ? Status::interrupted
                                               : Status::failed;
    if (member.status == Status::finished) {
      member.error.clear();
    } else if (member.status != Status::interrupted) {
      member.error = message_of(member);
      if (WIFSIGNALED(status))
        member.error =
            fmt::format("died by signal {} ({}) {}", WTERMSIG(status), strsignal(WTERMSIG(status)), member.error);
      if (member.error.empty()) member.error = fmt::format("ended with exit code {}", code);
    }
    try {
      read_facts(member);
    } catch (const std::exception& error) {
      if (member.error.empty()) member.error = fmt::format("run.json: {}", error.what());
    }
  }

  /// What the member said before it ended, on one line.
  static std::string message_of(const Member& member) {
    std::string text;
    try {
      text = read_text(errors_of(member));
    } catch (const Error&) {
      return {};
    }
    std::string line;
    for (const char c : text) {
      const bool space = c == ' ' || c == '\n' || c == '\t' || c == '\r';
      if (!space) line += c;
      if (space && !line.empty() && line.back() != ' ') line += ' ';
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (line.starts_with("error: ")) line.erase(0, std::string_view("error: ").size());
    return shortened(line, longest_error);
  }

  std::vector<Member>& members_;
  const RunnerOptions& options_;
  const std::function<void(const Member&)>& report_;
  std::vector<std::size_t> waiting_;
  std::vector<Child> running_;
};

}  // namespace

double available_memory() {
  std::ifstream info("/proc/meminfo");
  std::string word;
  while (info >> word)
    if (word == "MemAvailable:") {
      double kilobytes = 0;
      info >> kilobytes;
      return kilobytes * 1024;
    }
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

bool run_members(std::vector<Member>& members, const RunnerOptions& options,
                 const std::function<void(const Member&)>& report) {
  return Runner(members, options, report).run();
}

}  // namespace undine::study
