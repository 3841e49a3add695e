#include "undine/app/run/control.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include "undine/io/atomic_file.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::array<std::string_view, 3> words{"run", "pause", "stop"};
constexpr auto between_looks = 50ms;  ///< one look costs some microseconds

fs::path control_file(const fs::path& folder) { return folder / "control"; }

/// The first word of the file; empty where it cannot be read.
std::string wish_in(const fs::path& file) {
  std::array<char, 16> text{};
  std::ifstream(file).read(text.data(), text.size() - 1);
  const std::string all(text.data());
  return all.substr(0, all.find_first_of(" \t\r\n"));
}

}  // namespace

RunControl::~RunControl() {
  std::error_code ignored;
  if (enabled()) fs::remove(file_, ignored);
}

void RunControl::begin(const fs::path& folder, bool wanted) {
  std::error_code ignored;
  if (!wanted) {
    fs::remove(control_file(folder), ignored);
    return;
  }
  write_text_atomically(control_file(folder), "run\n");
  file_ = control_file(folder);
}

void RunControl::obey(std::atomic<bool>& stop, Clock::time_point& start, const std::function<void()>& tell) {
  const auto now = Clock::now();
  if (!enabled() || now - looked_ < between_looks) return;
  looked_ = now;
  if (!wants_pause(stop)) return;
  paused_ = true;
  tell();
  while (wants_pause(stop)) std::this_thread::sleep_for(between_looks);
  paused_ = false;
  looked_ = Clock::now();
  start += looked_ - now;
  tell();
}

/// Also hears "stop". A word that is not known changes nothing, so that a pause goes on.
bool RunControl::wants_pause(std::atomic<bool>& stop) const {
  const std::string wish = wish_in(file_);
  if (wish == "stop") stop = true;
  return !stop && (wish == "pause" || (paused_ && wish != "run"));
}

bool is_run_wish(std::string_view word) { return std::ranges::count(words, word) > 0; }

bool send_run_wish(const fs::path& folder, std::string_view word) {
  if (!fs::is_regular_file(control_file(folder))) return false;
  write_text_atomically(control_file(folder), std::string(word) + "\n");
  return true;
}

}  // namespace undine
