#pragma once
#include <filesystem>
#include <functional>
#include <memory>

#include "undine/app/run/checkpoints.hpp"
#include "undine/app/watchdog/diagnosis.hpp"
#include "undine/app/watchdog/watch.hpp"
#include "undine/io/case/document.hpp"

namespace undine {

/// An alarm with its moment in the run.
struct AlarmedRun {
  AlarmHit hit;
  double time = 0, dt = 0;     ///< s
  std::int64_t step = 0;       ///< the one that led to it
  std::int64_t last_good = 0;  ///< steps after which the state was still sound; -1: it never was
};

struct Examined {
  Evidence evidence;
  Diagnosis diagnosis;
  int window = 0;  ///< snapshots in the folder `window`
};

/// After an alarm: reads the case anew, goes on from the last checkpoint once more up to the step before the alarm
/// (the same bits, so it comes to the same end), keeps the last steps as snapshots in FOLDER/window, and says what
/// happened. The run itself pays nothing for it as long as all is well. `stop` ends the way back early.
template <int N>
Examined examine(const AlarmedRun& alarmed, const Flow<N>& flow, const Document& document,
                 const std::filesystem::path& folder, const Checkpoints& checkpoints,
                 const std::function<bool()>& stop);

/// Steps kept before the alarm.
inline constexpr std::int64_t window_steps = 10;

}  // namespace undine
