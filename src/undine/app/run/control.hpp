#pragma once
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <string_view>

namespace undine {

/// How a run that was started with --control hears of whoever may pause and stop it: a file in its folder, `control`,
/// holds one word: run, pause or stop. What else it may hold changes nothing.
class RunControl {
 public:
  using Clock = std::chrono::steady_clock;

  RunControl() = default;
  /// Takes the file away: nobody listens any more.
  ~RunControl();
  RunControl(const RunControl&) = delete;
  RunControl& operator=(const RunControl&) = delete;

  /// Puts the file into the folder where `wanted`; else removes what an earlier run may have left. Throws Error.
  void begin(const std::filesystem::path& folder, bool wanted);
  bool enabled() const { return !file_.empty(); }
  bool paused() const { return paused_; }

  /// Between two steps: waits for as long as the file says "pause", and sets `stop` where it says so. `start`, from
  /// which the run counts its seconds, moves by what it waited. `tell` is called when a wait has begun and when it has
  /// ended; `stop` set by others ends one too.
  void obey(std::atomic<bool>& stop, Clock::time_point& start, const std::function<void()>& tell);

 private:
  bool wants_pause(std::atomic<bool>& stop) const;

  std::filesystem::path file_;  ///< empty: nobody may control the run
  Clock::time_point looked_ = {};
  bool paused_ = false;
};

/// Whether the word is one that a run understands.
bool is_run_wish(std::string_view word);

/// Writes the word for a run to find. False where the run in the folder does not listen. Throws Error.
bool send_run_wish(const std::filesystem::path& folder, std::string_view word);

}  // namespace undine
