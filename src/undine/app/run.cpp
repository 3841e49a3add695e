#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>
#include <unistd.h>

#include "undine/app/case_setup.hpp"
#include "undine/app/gauges.hpp"
#include "undine/app/gauges/context.hpp"
#include "undine/app/machine.hpp"
#include "undine/app/report/report.hpp"
#include "undine/app/run_options.hpp"
#include "undine/app/run_output.hpp"
#include "undine/core/error.hpp"
#include "undine/integrators/catalogue.hpp"
#include "undine/io/output_folder.hpp"
#include "undine/io/run_record.hpp"
#include "undine/schemes/presets.hpp"

namespace undine {
namespace {

std::atomic<bool> interrupted{false};
void on_signal(int) { interrupted = true; }

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// One run of N dimensions, from the document to the report.
template <int N>
class Run {
 public:
  Run(Document& document, const RunOptions& options)
      : document_(document),
        options_(options),
        setup_(read_case<N>(document.root())),
        output_(read_output(document.root(), options, setup_.choice.end)),
        gauges_(document.root(), gauge_context(setup_, output_)) {
    for (const int f : output_.fields) setup_.options.kept.set(static_cast<std::size_t>(f));
    document.finish();
    hash_ = case_hash(document);
  }

  void describe() const {
    if (options_.verbosity != Verbosity::normal) return;
    const auto& o = setup_.options;
    const auto& store = setup_.store;
    const auto preset = presets::Presets::info(setup_.choice.preset).name;
    fmt::print("{}\n", setup_.title.empty() ? options_.file.string() : setup_.title);
    fmt::print("  particles   {} fluid, {} wall, spacing {:.4g} m, support {:.4g} m ({:.3g} spacings)\n",
               store.range(Group::fluid).size(), store.range(Group::wall).size(), setup_.spacing, o.support.uniform,
               o.support.uniform / setup_.spacing);
    fmt::print("  scheme      {}: kernel {}, pressure {}, {}{}{}{}{}\n", preset, o.kernels[0].info().name,
               o.pressure.info().name,
               o.density == DensityForm::evolved ? std::string(o.continuity.info().name) : "summation",
               o.viscosity ? fmt::format(", viscosity {}", o.viscosity->info().name) : "",
               o.artificial ? fmt::format(", artificial viscosity {}", o.artificial->info().name) : "",
               o.diffusion ? fmt::format(", diffusion {}", o.diffusion->info().name) : "", o.xsph ? ", XSPH" : "");
    fmt::print("  backend     {} x {}, pairs in {}, search {}\n", backend_names[static_cast<int>(o.backend.kind)],
               omp_get_max_threads(), precision_names[static_cast<int>(o.backend.precision)], o.neighbours.search);
    for (const auto& material : o.materials)
      fmt::print("  material    {}: rho_0 {:.6g} kg/m^3, c_0 {:.4g} m/s ({:.3g} x expected speed), mu {:.3g} Pa s\n",
                 material.name, material.rho_0, material.sound_speed(material.rho_0),
                 material.sound_speed(material.rho_0) / setup_.expected_speed, material.mu);
    const auto& limits = setup_.choice.limits;
    fmt::print("  time        to {:.6g} s, {}, {}\n", setup_.choice.end, setup_.choice.integrator,
               limits.fixed > 0 ? fmt::format("fixed step {:.4g} s", limits.fixed)
                                : fmt::format("Courant number {:.3g}", limits.courant));
    for (const auto& warning : setup_.warnings) fmt::print("  warning     {}\n", warning);
    std::fflush(stdout);
  }

  int run() {
    const auto start = Clock::now();
    if (options_.resume) checkpoint_ = Checkpoints(output_.folder).read_newest();
    if (checkpoint_ && checkpoint_->state.texts.at("case") != hash_)
      throw InputError({.what = "the checkpoint belongs to another case",
                        .where = {output_.folder.string()},
                        .why = "since it was written, keys other than time.end, output and gauges changed",
                        .fix = "use the same case file and --set words, or run without --resume"});
    prepare_output_folder(output_.folder, options_.resume      ? FolderMode::resume
                                          : options_.overwrite ? FolderMode::overwrite
                                                               : FolderMode::fresh);
    describe();
    make_flow();
    print_plan();

    const double resumed_at = checkpoint_ ? flow_->time() : -1;
    EnergySeries<N> energies(output_.folder, checkpoint_.has_value(), resumed_at);
    StepSeries steps(output_.folder, checkpoint_.has_value(), resumed_at);
    SeriesFile series = checkpoint_ ? SeriesFile::resume(output_.folder / "particles.vtkhdf.series", resumed_at)
                                    : SeriesFile::create(output_.folder / "particles.vtkhdf.series");
    if (checkpoint_) {
      gauges_.resume(output_.folder, resumed_at);
      energies.set_start(checkpoint_->state.reals.at("energy at start"),
                         checkpoint_->state.reals.at("potential at start"));
    } else {
      gauges_.create(output_.folder);
      const Energies e = flow_->energies();
      energies.set_start(e.total(), e.potential);
    }
    const bool fresh = !checkpoint_;
    if (checkpoint_) step_ = checkpoint_->frame.step;
    checkpoint_.reset();

    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    Step step = flow_->stable_step(setup_.choice.limits);
    double before = fresh ? -1 : flow_->time();
    progress_start_ = flow_->time();
    record("running", start, energies);
    int code = exit_ok;
    try {
      while (true) {
        write_due(before, energies, steps, series, step);
        const bool last = flow_->time() >= setup_.choice.end * (1 - 1e-12) || interrupted;
        if (last || (due(output_.checkpoints, before, flow_->time()) && flow_->time() > 0)) write_checkpoint(energies);
        if (last) break;
        progress(start, step, false);
        step = flow_->stable_step(setup_.choice.limits);
        check_step(step);
        before = flow_->time();
        integrators::Integrators::visit(integrators::Integrators::index_of(setup_.choice.integrator),
                                        [&]<class I>(I) { I::step(*flow_, step.dt); });
        ++step_;
        particle_updates_ += static_cast<double>(flow_->store().range(Group::fluid).size());
      }
    } catch (const RunError&) {
      record("went bad", start, energies);
      if (options_.verbosity == Verbosity::normal) fmt::print(stderr, "\n");
      report();
      throw;
    }
    if (interrupted) code = exit_interrupted;
    progress(start, step, true);
    record(interrupted ? "interrupted" : "finished", start, energies);
    summarise(start, energies);
    if (!interrupted) report();
    return code;
  }

 private:
  void make_flow() {
    if (!checkpoint_) {
      flow_ = std::make_unique<WeaklyCompressible<N>>(std::move(setup_.store), setup_.domain, setup_.options);
    } else {
      flow_ = std::make_unique<WeaklyCompressible<N>>(store_from(checkpoint_->frame), setup_.domain, setup_.options,
                                                      checkpoint_->state.lists.at("memory"));
    }
    flow_->set_potential_origin(setup_.potential_origin);
  }

  /// The particles of a checkpoint in their order, every field.
  static Store<N> store_from(const OwnedFrame& frame) {
    Store<N> store;
    FieldSet fields;
    for (int f = 0; f < FieldId::count; ++f)
      if (frame.find(all_fields[f].name)) fields.set(f);
    store.allocate(fields);
    const auto* groups = frame.find_integers("group");
    const auto* ids = frame.find_integers(identity_column);
    const auto* materials = frame.find_integers("material");
    std::size_t walls = 0;
    for (std::size_t i = 0; i < frame.particles; ++i) walls += groups->at(i) == 1;
    store.append(Group::fluid, frame.particles - walls, 0);
    store.append(Group::wall, walls, 0);
    for (std::size_t i = 0; i < frame.particles; ++i) {
      store.ids()[i] = ids->at(i);
      store.materials()[i] = static_cast<std::int32_t>(materials->at(i));
    }
    for (int f = 0; f < FieldId::count; ++f)
      if (const auto* column = frame.find(all_fields[f].name)) std::ranges::copy(column->data, store.raw(f).begin());
    return store;
  }

  void print_plan() const {
    if (options_.verbosity != Verbosity::normal) return;
    fmt::print("  evaluation  ");
    const auto& stages = flow_->plan().stages();
    for (std::size_t k = 0; k < stages.size(); ++k) fmt::print("{}{}", k ? " -> " : "", stages[k].name);
    print_path();
    fmt::print("  memory      {:.1f} MB fields, {:.1f} MB neighbour lists\n  output      {}\n",
               static_cast<double>(flow_->store().bytes()) * 1e-6,
               static_cast<double>(flow_->neighbours().bytes()) * 1e-6, output_.folder.string());
    std::fflush(stdout);
  }

  /// Which loops every sweep runs, and why: the choice is one for all of them.
  void print_path() const {
    const auto& o = setup_.options;
    const auto& backend = o.backend;
    if (backend.kind == BackendKind::threads) {
      const bool best = backend.instructions == best_instructions();
      fmt::print("\n  sweeps      all in packs of {}, {} instructions ({}), H {}\n",
                 backend.precision == PairPrecision::mixed ? "float" : "double",
                 instruction_set_names[static_cast<std::size_t>(backend.instructions)],
                 best ? "the widest here" : "named by the case", o.rho_law ? "of each pair" : "the same everywhere");
    } else {
      fmt::print("\n  sweeps      all one pair at a time in double (backend {})\n",
                 backend_names[static_cast<std::size_t>(backend.kind)]);
    }
    fmt::print("  loops       {}\n  neighbours  {}\n", flow_->describe_sweeps(), flow_->neighbours().describe());
  }

  void write_due(double before, EnergySeries<N>& energies, StepSeries& steps, SeriesFile& series, const Step& step) {
    const double now = flow_->time();
    if (due(output_.energies, before, now)) {
      energies.add(*flow_, step, step_);
      const auto& store = flow_->store();
      steps.add(now, step_, step, store.range(Group::fluid).size(), store.range(Group::wall).size());
    }
    gauges_.sample(*flow_);
    const std::string name = snapshot_due(output_, before, now);
    if (name.empty()) return;
    const auto watch = Clock::now();
    std::vector<std::int32_t> groups;
    write_snapshot(output_.folder / name, frame_of(*flow_, step_, output_.fields, groups));
    series.add(name, now);
    seconds_output_ += seconds_since(watch);
  }

  void write_checkpoint(const EnergySeries<N>& energies) {
    const auto watch = Clock::now();
    std::vector<std::int32_t> groups;
    CheckpointData data{frame_of(*flow_, step_, {}, groups), {}};
    data.state.lists["memory"] = flow_->memory();
    data.state.reals["energy at start"] = energies.start_total();
    data.state.reals["potential at start"] = energies.start_potential();
    data.state.texts["case"] = hash_;
    Checkpoints(output_.folder).write(data);
    seconds_output_ += seconds_since(watch);
  }

  void check_step(const Step& step) {
    if (first_step_ <= 0) first_step_ = step.dt;
    if (std::isfinite(step.dt) && step.dt > 1e-6 * first_step_) return;
    throw RunError(
        {.what = fmt::format("the time step collapsed to {:.3g} s at t = {:.6g} s", step.dt, flow_->time()),
         .why = fmt::format("it is limited by '{}'; the first step was {:.3g} s", step.limiter, first_step_),
         .fix = "look for particles that coincide or a pressure that grew beyond bounds in the last snapshot"});
  }

  double rate(Clock::time_point start) const { return particle_updates_ / std::max(1e-9, seconds_since(start)); }

  /// Seconds that the rest takes at the pace so far.
  double remaining(Clock::time_point start) const {
    const double done = flow_->time() - progress_start_, left = setup_.choice.end - flow_->time();
    return done > 0 ? std::max(0.0, seconds_since(start) * left / done) : 0;
  }

  std::string progress_line(Clock::time_point start, const Step& step) const {
    return to_line(Json{{"time", flow_->time()},
                        {"end", setup_.choice.end},
                        {"step", step_},
                        {"dt", step.dt},
                        {"limiter", step.limiter},
                        {"rate", rate(start)},
                        {"remaining_s", remaining(start)}});
  }

  /// Says how far the run is: to whoever follows it, once a second, and to its user.
  void progress(Clock::time_point start, const Step& step, bool last) {
    if (last || seconds_since(last_file_) >= 1) {
      last_file_ = Clock::now();
      write_progress(output_.folder, progress_line(start, step));
    }
    if (options_.verbosity == Verbosity::quiet) return;
    const bool terminal = isatty(STDOUT_FILENO) != 0;
    const double wait = terminal ? 0.5 : 10.0;
    if (!last && seconds_since(last_progress_) < wait) return;
    last_progress_ = Clock::now();
    if (options_.verbosity == Verbosity::json) {
      fmt::print("{}\n", progress_line(start, step));
    } else {
      fmt::print(
          "{}  t = {:.4f} of {:.4g} s, step {}, dt {:.3g} s ({}), {:.3g} M particle updates/s, {:.0f} s to go   {}",
          terminal ? "\r" : "", flow_->time(), setup_.choice.end, step_, step.dt, step.limiter, rate(start) * 1e-6,
          remaining(start), terminal && !last ? "" : "\n");
    }
    std::fflush(stdout);
  }

  void record(const std::string& status, Clock::time_point start, const EnergySeries<N>& energies) const {
    Json resolved = Json::object();
    for (const auto& [key, value] : document_.resolved()) resolved[key] = value;
    const Energies e = flow_->energies();
    const Machine machine = this_machine();
    Json stages = Json::array();
    for (const auto& stage : flow_->plan().stages())
      stages.push_back({{"name", stage.name}, {"reads", stage.reads.text()}, {"writes", stage.writes.text()}});
    write_json(output_.folder / "run.json",
               Json{{"program", "undine"},
                    {"version", program_version()},
                    {"status", status},
                    {"case", options_.file.string()},
                    {"case_hash", hash_},
                    {"resolved", resolved},
                    {"warnings", setup_.warnings},
                    {"stages", stages},
                    {"threads", omp_get_max_threads()},
                    {"machine",
                     {{"processor", machine.processor},
                      {"cores", machine.cores},
                      {"memory_gb", machine.memory_gb},
                      {"system", machine.system}}},
                    {"particles",
                     {{"fluid", flow_->store().range(Group::fluid).size()},
                      {"wall", flow_->store().range(Group::wall).size()}}},
                    {"time", flow_->time()},
                    {"steps", step_},
                    {"list_builds", flow_->list_builds()},
                    {"seconds",
                     {{"total", seconds_since(start)},
                      {"sweeps", flow_->seconds_sweeps()},
                      {"lists", flow_->seconds_lists()},
                      {"output", seconds_output_}}},
                    {"particle_updates_per_s", rate(start)},
                    {"memory_bytes", {{"fields", flow_->store().bytes()}, {"lists", flow_->neighbours().bytes()}}},
                    {"energy",
                     {{"kinetic", e.kinetic},
                      {"potential", e.potential},
                      {"elastic", e.elastic},
                      {"total", e.total()},
                      {"residual_relative", energies.relative_residual(e)}}}});
  }

  void summarise(Clock::time_point start, const EnergySeries<N>& energies) const {
    if (options_.verbosity != Verbosity::normal) return;
    const Energies e = flow_->energies();
    const double total = seconds_since(start);
    const auto share = [&](double seconds) { return 100 * seconds / total; };
    fmt::print(
        "\n{} steps in {:.1f} s: {:.3g} M particle updates/s; sweeps {:.0f} %, lists {:.0f} % ({} builds), output "
        "{:.0f} %\n",
        step_, total, rate(start) * 1e-6, share(flow_->seconds_sweeps()), share(flow_->seconds_lists()),
        flow_->list_builds(), share(seconds_output_));
    fmt::print(
        "energy: kinetic {:.4g}, potential {:.4g}, elastic {:.4g} J; taken by viscosity {:.4g}, artificial {:.4g}, "
        "diffusion {:.4g}, walls {:.4g} J\n",
        e.kinetic, e.potential, e.elastic, e.ledger.viscous, e.ledger.artificial, e.ledger.diffusion, e.ledger.walls);
    fmt::print("energy audit residual: {:.2e} of the initial potential energy\n", energies.relative_residual(e));
    const auto comparisons = gauges_.compare();
    if (!comparisons.empty()) fmt::print("\n{}", comparison_table(comparisons));
    fmt::print("results in {}\n", output_.folder.string());
  }

  /// The page that shows the run. A run is as good as ever without it.
  void report() const {
    if (!output_.report) return;
    try {
      const WrittenReport written = write_report({.folder = output_.folder, .out = {}});
      if (options_.verbosity == Verbosity::normal) fmt::print("to look at in {}\n", written.file.string());
    } catch (const std::exception& error) {
      fmt::print(stderr, "warning: no report was written: {}\n", error.what());
    }
  }

  Document& document_;
  const RunOptions& options_;
  CaseSetup<N> setup_;
  OutputPlan output_;
  GaugeSet<N> gauges_;
  std::string hash_;
  std::optional<OwnedCheckpoint> checkpoint_;
  std::unique_ptr<WeaklyCompressible<N>> flow_;
  std::int64_t step_ = 0;
  double particle_updates_ = 0, seconds_output_ = 0, first_step_ = 0, progress_start_ = 0;
  Clock::time_point last_progress_ = Clock::now(), last_file_ = {};
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
