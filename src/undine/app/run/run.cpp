#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include "undine/app/flow_of_case.hpp"
#include "undine/app/gauges.hpp"
#include "undine/app/gauges/context.hpp"
#include "undine/app/report/report.hpp"
#include "undine/app/run/checkpoints.hpp"
#include "undine/app/run/control.hpp"
#include "undine/app/run/output.hpp"
#include "undine/app/run/talk.hpp"
#include "undine/app/tell.hpp"
#include "undine/app/watchdog/post_mortem.hpp"
#include "undine/app/watchdog/subject.hpp"
#include "undine/core/stopwatch.hpp"
#include "undine/io/output_folder.hpp"

namespace undine {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<bool> interrupted{false}, signalled{false};
std::atomic<Clock::time_point> first_signal;

/// Ends the run after its step. A second signal ends the process at once, as its files are whole at any time; but not
/// one within a second, as the terminal and the study that a run belongs to both pass on the first.
void on_signal(int number) {
  interrupted = true;
  const auto now = Clock::now();
  if (!signalled.exchange(true)) {
    first_signal = now;
  } else if (now - first_signal.load() > std::chrono::seconds(1)) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
}

/// One run of N dimensions, from the document to the report.
template <int N>
class Run {
 public:
  Run(Document& document, const RunOptions& options)
      : document_(document),
        options_(options),
        setup_(read_case<N>(document.root())),
        output_(read_output(document.root(), options, setup_.choice.end)),
        limits_(read_watch_limits(document.root())),
        gauges_(document.root(), gauge_context(setup_, output_)),
        talk_(options_, setup_, output_),
        clock_(output_.checkpoints, output_.checkpoint_wall_time) {
    for (const int f : output_.fields) setup_.options().kept.set(static_cast<std::size_t>(f));
    document.finish();
    checkpoints_.emplace(output_.folder, fitting_keys(document), case_hash(document),
                         rounding_of(setup_.options().backend));
  }

  void describe() const { talk_.describe(); }

  int run() {
    std::signal(SIGPIPE, SIG_IGN);  // who reads what is told may go
    const bool resumed = open();
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    if (std::signal(SIGHUP, SIG_IGN) != SIG_IGN) std::signal(SIGHUP, on_signal);  // not under nohup
    try {
      if (!resumed) begin();
      record("running");
      talk_.plan(*flow_);
      watch_->begin(*flow_);
      advance();
    } catch (const RunError& error) {
      go_bad(error);
    } catch (const Error& error) {
      record_if_possible("could not write", error.what());
      throw;
    }
    talk_.progress(*flow_, pace_, step_, true);
    record(is_at_end() ? "finished" : "interrupted");
    talk_.summary(*flow_, pace_, *energies_, gauges_.compare());
    if (!is_at_end()) return exit_interrupted;
    report();
    return exit_ok;
  }

 private:
  /// From the case or from a checkpoint to a flow, and files that wait for what comes. Whether it was a checkpoint.
  bool open() {
    std::optional<FoundCheckpoint> found;
    if (options_.resume) claim_ = FolderClaim::of(output_.folder);  // before what another run writes is read
    const bool unbegun = options_.resume && checkpoints_->began_without();
    if (options_.resume && !unbegun) found = checkpoints_->read_newest();
    claim_ = prepare_output_folder(output_.folder,
                                   options_.resume      ? FolderMode::resume
                                   : options_.overwrite ? FolderMode::overwrite
                                                        : FolderMode::fresh,
                                   std::move(claim_));
    control_.begin(output_.folder, options_.control);
    pace_.listens = control_.enabled();
    if (unbegun) talk_.warn("the earlier run ended before its first checkpoint; this one starts from the beginning");
    if (found) say_refused(*found);
    if (found && found->rounding != checkpoints_->rounding()) say_it_rounds_otherwise(found->rounding);
    talk_.describe();
    watch_.emplace(limits_, watch_subject(setup_), setup_.options().materials);
    flow_ = flow_of_case(setup_, found ? &found->checkpoint : nullptr);

    for (const char* name : {"energies.csv", "steps.csv"})
      if (found && !std::filesystem::exists(output_.folder / name))
        talk_.warn(fmt::format("{} of the earlier run is gone; its rows begin anew", name));
    const double resumed_at = found ? flow_->time() : -1;
    const auto list = output_.folder / "particles.vtkhdf.series";
    energies_.emplace(output_.folder, found.has_value(), resumed_at);
    steps_.emplace(output_.folder, found.has_value(), resumed_at);
    series_.emplace(found ? SeriesFile::resume(list, resumed_at) : SeriesFile::create(list));
    if (found) {
      gauges_.resume(output_.folder, resumed_at);
      const auto& reals = found->checkpoint.state.reals;
      energies_->set_start(reals.at("energy at start"), reals.at("potential at start"));
      pace_.step = found->checkpoint.frame.step;
    } else {
      gauges_.create(output_.folder);
    }
    before_ = resumed_at;
    pace_.from = flow_->time();
    pace_.end = setup_.choice.end;
    return found.has_value();
  }

  /// The first rates.
  void begin() {
    moment_ = Moment::first_rates;
    flow_->start();
    moment_ = Moment::chosen_step;
    const Energies e = flow_->energies();
    energies_->set_start(e.total(), e.potential);
  }

  void say_it_rounds_otherwise(const std::string& before) const {
    talk_.warn(
        fmt::format("the checkpoint is of {}, and this is {}: the run goes on, but need not come to the same bits "
                    "as one that never stopped; `scheme.instructions` names a set that all machines have",
                    before.empty() ? "an older undine" : before, checkpoints_->rounding()));
  }

  void say_refused(const FoundCheckpoint& found) const {
    for (const std::string& reason : found.refused) talk_.warn("a checkpoint cannot be used: " + reason);
    if (found.refused.empty()) return;
    talk_.warn(fmt::format("the run goes on from the one before, {}, at step {}", found.file.filename().string(),
                           found.checkpoint.frame.step));
    checkpoints_->set_aside_newer_than(found.file);
  }

  /// Steps until the end, each looked at before anything of it is kept.
  void advance() {
    step_ = next_step(*flow_, setup_.choice);
    while (true) {
      control_.obey(interrupted, pace_.start, [&] {
        pace_.paused = control_.paused();
        talk_.progress(*flow_, pace_, step_, true);
      });
      const bool last = is_at_end() || interrupted;
      const bool first = before_ < 0;
      const bool keeps_state = last || first || clock_.due(before_, flow_->time());
      if (keeps_state || look_is_due()) look();
      write_due();
      if (keeps_state) write_checkpoint();
      if (last) return;
      talk_.progress(*flow_, pace_, step_, false);
      step_ = next_step(*flow_, setup_.choice);
      moment_ = Moment::chosen_step;
      watch_->step(*flow_, step_);
      before_ = flow_->time();
      moment_ = Moment::within_step;
      take_step(*flow_, setup_.choice, step_.dt);
      moment_ = Moment::after_step;
      ++pace_.step;
      pace_.particle_updates += static_cast<double>(flow_->store().range(Group::fluid).size());
      const Stopwatch watch(pace_.seconds_watch);
      watch_->quickly(*flow_);
    }
  }

  bool is_at_end() const { return flow_->time() >= setup_.choice.end * (1 - 1e-12); }

  bool look_is_due() const {
    const std::int64_t since = pace_.step - looked_at_;
    return !snapshot_due(output_, before_, flow_->time()).empty() || since >= 256 ||
           (since >= 128 && due(output_.energies, before_, flow_->time()));
  }
  void look() {
    const Stopwatch watch(pace_.seconds_watch);
    watch_->fully(*flow_);
    looked_at_ = pace_.step;
  }

  void write_due() {
    const double now = flow_->time();
    if (due(output_.energies, before_, now)) {
      energies_->add(*flow_, step_, pace_.step);
      const auto& store = flow_->store();
      steps_->add(now, pace_.step, step_, store.range(Group::fluid).size(), store.range(Group::wall).size());
    }
    gauges_.sample(*flow_);
    const std::string name = snapshot_due(output_, before_, now);
    if (name.empty()) return;
    const auto watch = Pace::Clock::now();
    std::vector<std::int32_t> groups;
    write_snapshot(output_.folder / name, frame_of(*flow_, pace_.step, output_.fields, groups));
    series_->add(name, now);
    pace_.seconds_output += Pace::seconds_since(watch);
  }

  void write_checkpoint() {
    const auto watch = Pace::Clock::now();
    std::vector<std::int32_t> groups;
    CheckpointData data{frame_of(*flow_, pace_.step, {}, groups), {}};
    data.state.lists["memory"] = flow_->memory();
    data.state.reals["energy at start"] = energies_->start_total();
    data.state.reals["potential at start"] = energies_->start_potential();
    checkpoints_->write(std::move(data));
    clock_.written();
    pace_.seconds_output += Pace::seconds_since(watch);
  }

  /// What happened, why, and what to change: to the user, into diagnosis.txt and into run.json.
  [[noreturn]] void go_bad(const RunError& error) {
    const auto* alarm = dynamic_cast<const AlarmError*>(&error);
    const auto hit = alarm ? std::optional(alarm->hit()) : hit_of(error, *flow_);
    if (!hit) bad_without_cause();  // the error says all that there is to say
    if (talk_.normal()) tell(stderr, "\n{}\nlooking for the cause\n", error.what());
    const AlarmedRun alarmed{.hit = *hit,
                             .time = flow_->time(),
                             .dt = step_.dt,
                             .step = pace_.step + (moment_ == Moment::within_step ? 1 : 0),
                             .last_good = pace_.step - (knows_state_is_bad() ? 1 : 0)};
    const auto examined = examine_if_possible(alarmed);
    if (!examined) bad_without_cause();
    const Examined& found = *examined;
    const std::string text = diagnosis_text(found.diagnosis, found.evidence);
    if (talk_.normal()) tell(stderr, "\n{}\n", text);
    const auto file = output_.folder / "diagnosis.txt";
    try {
      write_text_atomically(file, text);
    } catch (const Error&) {  // the disk may be full; it is printed anyway
    }
    record_if_possible("went bad", {}, diagnosis_json(found.diagnosis, found.evidence));
    report();
    throw RunError({.what = describe_alarm(found.evidence),
                    .where = {file.string()},
                    .why = fmt::format("{}: {}", found.diagnosis.cause, found.diagnosis.because),
                    .fix = found.diagnosis.remedy});
  }

  /// Nothing where a file that the case names has changed or gone since the run began.
  std::optional<Examined> examine_if_possible(const AlarmedRun& alarmed) const {
    try {
      return examine(alarmed, *flow_, document_, output_.folder, *checkpoints_, [] { return interrupted.load(); });
    } catch (const InputError& error) {
      talk_.warn(fmt::format("the case cannot be read again to look for the cause: {}", error.what()));
      return {};
    }
  }

  /// Throws on the error that is being handled.
  [[noreturn]] void bad_without_cause() const {
    record_if_possible("went bad", {});
    report();
    throw;
  }

  void record(const std::string& status, const Json& more = Json::object()) const {
    Json resolved = Json::object();
    for (const auto& [key, value] : document_.resolved()) resolved[key] = value;
    Json json{{"program", "undine"},
              {"version", program_version()},
              {"status", status},
              {"case", options_.file.string()},
              {"case_hash", checkpoints_->hash()},
              {"resolved", resolved},
              {"warnings", setup_.warnings}};
    json.update(run_json(*flow_, pace_, *energies_));
    json.update(more);
    write_json(output_.folder / "run.json", json);
  }

  /// Where the disk itself may be what went wrong.
  void record_if_possible(const std::string& status, const std::string& error, Json diagnosis = nullptr) const {
    Json more = Json::object();
    if (!error.empty()) more["error"] = error;
    if (!diagnosis.is_null()) more["diagnosis"] = std::move(diagnosis);
    try {
      record(status, more);
    } catch (const Error&) {
    }
  }

  /// The page that shows the run. A run is as good as ever without it.
  void report() const {
    if (!output_.report) return;
    try {
      const WrittenReport written = write_report({.folder = output_.folder, .out = {}});
      if (talk_.normal()) tell(stdout, "to look at in {}\n", written.file.string());
    } catch (const std::exception& error) {
      talk_.warn(fmt::format("no report was written: {}", error.what()));
    }
  }

  /// Where in a step the run is, for whoever asks which state was the last good one.
  enum class Moment { first_rates, chosen_step, within_step, after_step };
  bool knows_state_is_bad() const { return moment_ == Moment::first_rates || moment_ == Moment::after_step; }

  Document& document_;
  const RunOptions& options_;
  CaseSetup<N> setup_;
  OutputPlan output_;
  WatchLimits limits_;
  GaugeSet<N> gauges_;
  RunTalk<N> talk_;
  CheckpointClock clock_;
  std::optional<Checkpoints> checkpoints_;
  FolderClaim claim_;
  std::optional<Watch<N>> watch_;
  std::unique_ptr<Flow<N>> flow_;
  std::optional<EnergySeries<N>> energies_;
  std::optional<StepSeries> steps_;
  std::optional<SeriesFile> series_;
  Pace pace_;
  RunControl control_;
  Step step_{};
  Moment moment_ = Moment::chosen_step;
  double before_ = -1;  ///< s, the time of the step before; < 0: there was none
  std::int64_t looked_at_ = 0;
};

/// Loads the case and calls f(run) for a run of its dimensions.
template <class F>
int with_run(const RunOptions& options, F&& f) {
  if (options.threads > 0) omp_set_num_threads(options.threads);
  Document document = Document::load(options.file);
  for (const auto& assignment : options.sets) document.set(assignment);
  const Table root = document.root();
  switch (root.integer("dimensions", 3)) {
    case 1:
      return f(std::make_unique<Run<1>>(document, options));
    case 2:
      return f(std::make_unique<Run<2>>(document, options));
    case 3:
      return f(std::make_unique<Run<3>>(document, options));
    default:
      root.fail("dimensions", "dimensions must be 1, 2 or 3", {}, "choose one of them");
  }
}

}  // namespace

int check_case(const RunOptions& options) {
  return with_run(options, [](const auto& run) {
    run->describe();
    return exit_ok;
  });
}

int run_case(const RunOptions& options) {
  return with_run(options, [](const auto& run) { return run->run(); });
}

}  // namespace undine
