#include "undine/app/run/talk.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>
#include <unistd.h>

#include "undine/app/machine.hpp"
#include "undine/app/tell.hpp"
#include "undine/schemes/presets.hpp"

namespace undine {

template <int N>
void RunTalk<N>::describe() const {
  if (!normal()) return;
  const auto& o = setup_.options();
  const auto& store = setup_.store;
  const auto preset = presets::Presets::info(setup_.choice.preset).name;
  tell(stdout, "{}\n", setup_.title.empty() ? options_.file.string() : setup_.title);
  tell(stdout, "  particles   {} fluid, {} wall, spacing {:.4g} m, support {:.4g} m ({:.3g} spacings)\n",
       store.range(Group::fluid).size(), store.range(Group::wall).size(), setup_.spacing, o.support.uniform,
       o.support.uniform / setup_.spacing);
  tell(stdout, "  scheme      {}: kernel {}, {}\n", preset, o.kernels[0].info().name, describe_terms<N>(setup_.scheme));
  tell(stdout, "  backend     {} x {}, pairs in {}, search {}\n", backend_names[static_cast<int>(o.backend.kind)],
       omp_get_max_threads(), precision_names[static_cast<int>(o.backend.precision)], o.neighbours.search);
  for (const auto& material : o.materials) {
    tell(stdout, "  material    {}: rho_0 {:.6g} kg/m^3", material.name, material.rho_0);
    if (!setup_.choice.is_gas)
      tell(stdout, ", c_0 {:.4g} m/s ({:.3g} x expected speed)", material.sound_speed(material.rho_0),
           material.sound_speed(material.rho_0) / setup_.expected_speed);
    tell(stdout, ", mu {:.3g} Pa s\n", material.mu);
  }
  const auto& limits = setup_.choice.limits;
  tell(stdout, "  time        to {:.6g} s, {}, {}\n", setup_.choice.end, setup_.choice.integrator,
       limits.fixed > 0 ? fmt::format("fixed step {:.4g} s", limits.fixed)
                        : fmt::format("Courant number {:.3g}", limits.courant));
  for (const auto& warning : setup_.warnings) tell(stdout, "  warning     {}\n", warning);
  std::fflush(stdout);
}

template <int N>
void RunTalk<N>::plan(const Flow<N>& flow) const {
  if (!normal()) return;
  tell(stdout, "  evaluation  ");
  const auto& stages = flow.plan().stages();
  for (std::size_t k = 0; k < stages.size(); ++k) tell(stdout, "{}{}", k ? " -> " : "", stages[k].name);
  path(flow);
  tell(stdout, "  memory      {:.1f} MB fields, {:.1f} MB neighbour lists\n  output      {}\n",
       static_cast<double>(flow.store().bytes()) * 1e-6, static_cast<double>(flow.neighbours().bytes()) * 1e-6,
       output_.folder.string());
  std::fflush(stdout);
}

/// Which loops every sweep runs, and why: the choice is one for all of them.
template <int N>
void RunTalk<N>::path(const Flow<N>& flow) const {
  const auto& backend = flow.options().backend;
  if (backend.kind == BackendKind::threads) {
    const bool best = backend.instructions == best_instructions();
    tell(stdout, "\n  sweeps      all in packs of {}, {} instructions ({}), H {}\n",
         backend.precision == PairPrecision::mixed ? "float" : "double",
         instruction_set_names[static_cast<std::size_t>(backend.instructions)],
         best ? "the widest here" : "named by the case",
         flow.options().supports_vary() ? "of each pair" : "the same everywhere");
  } else {
    tell(stdout, "\n  sweeps      all one pair at a time in double (backend {})\n",
         backend_names[static_cast<std::size_t>(backend.kind)]);
  }
  tell(stdout, "  loops       {}\n  neighbours  {}\n", flow.describe_sweeps(), flow.neighbours().describe());
}

template <int N>
std::string RunTalk<N>::progress_line(const Flow<N>& flow, const Pace& pace, const Step& step) const {
  return to_line(Json{{"time", flow.time()},
                      {"end", pace.end},
                      {"step", pace.step},
                      {"dt", step.dt},
                      {"limiter", step.limiter},
                      {"rate", pace.rate()},
                      {"remaining_s", pace.remaining(flow.time())},
                      {"control", pace.listens},
                      {"paused", pace.paused}});
}

template <int N>
void RunTalk<N>::progress(const Flow<N>& flow, const Pace& pace, const Step& step, bool last) {
  if (last || Pace::seconds_since(last_file_) >= 1) {
    last_file_ = Pace::Clock::now();
    write_progress(output_.folder, progress_line(flow, pace, step));
  }
  if (options_.verbosity == Verbosity::quiet) return;
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  const double wait = terminal ? 0.5 : 10.0;
  if (!last && Pace::seconds_since(last_line_) < wait) return;
  last_line_ = Pace::Clock::now();
  if (options_.verbosity == Verbosity::json) {
    tell(stdout, "{}\n", progress_line(flow, pace, step));
  } else {
    tell(stdout,
         "{}  {}t = {:.4f} of {:.4g} s, step {}, dt {:.3g} s ({}), {:.3g} M particle updates/s, {:.0f} s to go   {}",
         terminal ? "\r" : "", pace.paused ? "paused at " : "", flow.time(), pace.end, pace.step, step.dt, step.limiter,
         pace.rate() * 1e-6, pace.remaining(flow.time()), terminal && !last ? "" : "\n");
  }
  std::fflush(stdout);
}

template <int N>
void RunTalk<N>::summary(const Flow<N>& flow, const Pace& pace, const EnergySeries<N>& energies,
                         const std::vector<Comparison>& comparisons) const {
  if (!normal()) return;
  const Energies e = flow.energies();
  const double total = pace.seconds();
  const auto share = [&](double seconds) { return 100 * seconds / total; };
  tell(stdout,
       "\n{} steps in {:.1f} s: {:.3g} M particle updates/s; sweeps {:.0f} %, lists {:.0f} % ({} builds), output "
       "{:.0f} %\n",
       pace.step, total, pace.rate() * 1e-6, share(flow.seconds_sweeps()), share(flow.seconds_lists()),
       flow.list_builds(), share(pace.seconds_output));
  tell(stdout,
       "energy: kinetic {:.4g}, potential {:.4g}, elastic {:.4g} J; taken by viscosity {:.4g}, artificial {:.4g}, "
       "diffusion {:.4g}, walls {:.4g} J\n",
       e.kinetic, e.potential, e.elastic, e.ledger.viscous, e.ledger.artificial, e.ledger.diffusion, e.ledger.walls);
  tell(stdout, "energy audit residual: {:.2e} of the initial potential energy\n", energies.relative_residual(e));
  if (!comparisons.empty()) tell(stdout, "\n{}", comparison_table(comparisons));
  tell(stdout, "results in {}\n", output_.folder.string());
}

template <int N>
void RunTalk<N>::warn(const std::string& text) const {
  tell(stderr, "warning: {}\n", text);
}

template <int N>
Json run_json(const Flow<N>& flow, const Pace& pace, const EnergySeries<N>& energies) {
  const Energies e = flow.energies();
  const Machine machine = this_machine();
  Json stages = Json::array();
  for (const auto& stage : flow.plan().stages())
    stages.push_back({{"name", stage.name}, {"reads", stage.reads.text()}, {"writes", stage.writes.text()}});
  return Json{{"stages", stages},
              {"threads", omp_get_max_threads()},
              {"machine",
               {{"processor", machine.processor},
                {"cores", machine.cores},
                {"memory_gb", machine.memory_gb},
                {"system", machine.system}}},
              {"particles",
               {{"fluid", flow.store().range(Group::fluid).size()}, {"wall", flow.store().range(Group::wall).size()}}},
              {"time", flow.time()},
              {"steps", pace.step},
              {"list_builds", flow.list_builds()},
              {"seconds",
               {{"total", pace.seconds()},
                {"sweeps", flow.seconds_sweeps()},
                {"lists", flow.seconds_lists()},
                {"output", pace.seconds_output},
                {"watchdog", pace.seconds_watch}}},
              {"particle_updates_per_s", pace.rate()},
              {"memory_bytes", {{"fields", flow.store().bytes()}, {"lists", flow.neighbours().bytes()}}},
              {"energy",
               {{"kinetic", e.kinetic},
                {"potential", e.potential},
                {"elastic", e.elastic},
                {"total", e.total()},
                {"residual_relative", energies.relative_residual(e)}}}};
}

template class RunTalk<1>;
template class RunTalk<2>;
template class RunTalk<3>;
template Json run_json(const Flow<1>&, const Pace&, const EnergySeries<1>&);
template Json run_json(const Flow<2>&, const Pace&, const EnergySeries<2>&);
template Json run_json(const Flow<3>&, const Pace&, const EnergySeries<3>&);

}  // namespace undine
