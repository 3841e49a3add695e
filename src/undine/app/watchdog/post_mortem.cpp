#include "undine/app/watchdog/post_mortem.hpp"

#include <map>
#include <optional>

#include <fmt/format.h>

#include "undine/app/case_setup.hpp"
#include "undine/app/flow_of_case.hpp"
#include "undine/app/run/output.hpp"
#include "undine/app/watchdog/collect.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

/// The snapshots around an alarm, with a list of them for ParaView. A full disk must not hide the diagnosis.
class Window {
 public:
  explicit Window(const fs::path& folder)
      : folder_(folder), series_(SeriesFile::create(folder / "steps.vtkhdf.series")) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    fs::create_directories(folder_, ignored);
  }

  template <int N>
  void add(const Flow<N>& flow, std::int64_t step) {
    static const std::vector<int> fields{field::v::id, field::rho::id, field::p::id, field::m::id, field::acc::id};
    const std::string name = fmt::format("step_{:012}.vtkhdf", step);
    std::vector<std::int32_t> groups;
    try {
      write_snapshot(folder_ / name, frame_of(flow, step, fields, groups));
      series_.add(name, flow.time());
    } catch (const Error&) {
    }
  }
  int size() const { return static_cast<int>(series_.size()); }

 private:
  fs::path folder_;
  SeriesFile series_;
};

/// The state after `last` steps; nothing where there is no way to it.
template <int N>
std::unique_ptr<Flow<N>> come_back(CaseSetup<N>& setup, const Checkpoints& checkpoints, std::int64_t last,
                                   Window& window, const std::function<bool()>& stop) {
  std::optional<FoundCheckpoint> found;
  try {
    found = checkpoints.read_newest();
  } catch (const InputError&) {  // then from the start
  }
  if (found && found->checkpoint.frame.step > last) found.reset();
  try {
    std::int64_t step = found ? found->checkpoint.frame.step : 0;
    auto flow = flow_of_case(setup, found ? &found->checkpoint : nullptr);
    if (!found) flow->start();
    for (;; ++step) {
      if (step + window_steps > last) window.add(*flow, step);
      if (step == last) return flow;
      if (stop()) return {};
      take_step(*flow, setup.choice, next_step(*flow, setup.choice).dt);
    }
  } catch (const RunError&) {
    return {};
  }
}

}  // namespace

template <int N>
Examined examine(const AlarmedRun& alarmed, const Flow<N>& flow, const Document& document, const fs::path& folder,
                 const Checkpoints& checkpoints, const std::function<bool()>& stop) {
  Examined examined;
  Evidence& e = examined.evidence;
  e.alarm = alarmed.hit.alarm;
  e.time = alarmed.time;
  e.step = alarmed.step;
  e.dt = alarmed.dt;
  e.particle.id = alarmed.hit.particle;
  CaseSetup<N> setup = read_case<N>(document.root());
  std::map<std::string, std::string> resolved;
  for (const auto& [key, value] : document.resolved()) resolved.emplace(key, value);
  collect_case(e, setup, resolved);
  collect_exit(e, flow, setup);
  Window window(folder / "window");
  const bool began = alarmed.last_good >= 0;
  const auto before =
      began ? come_back(setup, checkpoints, alarmed.last_good, window, stop) : std::unique_ptr<Flow<N>>();
  if (before && e.alarm == Alarm::not_finite)
    if (const std::int64_t first = first_not_finite(flow, *before); first >= 0) e.particle.id = first;
  collect_state(e, before ? *before : flow, setup,
                before || e.alarm == Alarm::not_finite ? Rates::known : Rates::missing);
  if (alarmed.step != alarmed.last_good) window.add(flow, alarmed.step);
  examined.window = window.size();
  examined.diagnosis = diagnose(e);
  return examined;
}

template Examined examine(const AlarmedRun&, const Flow<1>&, const Document&, const fs::path&, const Checkpoints&,
                          const std::function<bool()>&);
template Examined examine(const AlarmedRun&, const Flow<2>&, const Document&, const fs::path&, const Checkpoints&,
                          const std::function<bool()>&);
template Examined examine(const AlarmedRun&, const Flow<3>&, const Document&, const fs::path&, const Checkpoints&,
                          const std::function<bool()>&);

}  // namespace undine
