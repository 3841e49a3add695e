#include "undine/app/run/output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

namespace undine {
namespace {

const std::vector<std::string> energy_comments{
    "kinetic, potential, elastic: energies of the fluid, elastic the internal energy of a gas; the next columns: "
    "what each term took out of them since t = 0",
    "viscous, artificial: viscosities; diffusion: density diffusion; exchange: pressure work without matching "
    "compression;",
    "walls: given to walls; xsph: moved against gravity by XSPH; body: given to imposed fields",
    "total: their sum; residual = total - total at t = 0; residual_relative: of the initial potential energy (or the "
    "largest energy)",
    "strain_dissipation: integral of 2 mu D:D over fluid and time; saalfeld_dissipation: integral of mu D:D over the "
    "fluid, as printed in his eq. 51;",
    "both 0 unless output.strain_dissipation = true"};

std::vector<SeriesColumn> step_columns() {
  return {{"time", "s"}, {"step"}, {"dt", "s"}, {"limiter"}, {"fluid"}, {"wall"}};
}

std::vector<std::string> step_comments() {
  std::string text = "dt: the step that was taken last; limiter: what limits it";
  for (std::size_t k = 0; k < step_limiters.size(); ++k)
    text += fmt::format("{} {} {}", k ? "," : ":", k, step_limiters[k]);
  return {text + "; fluid, wall: numbers of particles"};
}

}  // namespace

std::vector<SeriesColumn> energy_columns() {
  return {{"time", "s"},
          {"step"},
          {"dt", "s"},
          {"kinetic", "J"},
          {"potential", "J"},
          {"elastic", "J"},
          {"viscous", "J"},
          {"artificial", "J"},
          {"diffusion", "J"},
          {"exchange", "J"},
          {"walls", "J"},
          {"xsph", "J"},
          {"body", "J"},
          {"total", "J"},
          {"residual", "J"},
          {"residual_relative"},
          {"strain_dissipation", "J"},
          {"saalfeld_dissipation", "W"}};
}

OutputPlan read_output(const Table& root, const RunOptions& options, double end) {
  const Table table = root.table("output");
  OutputPlan plan;
  const std::string folder = table.text("folder", (std::filesystem::path("out") / options.file.stem()).string());
  plan.folder = options.out.empty() ? std::filesystem::path(folder) : options.out;
  plan.snapshots = table.non_negative("snapshots", unit::time, end / 20);
  plan.at = table.quantities("at", unit::time, -1, {});
  for (const double t : plan.at)
    if (!(t >= 0)) table.fail("at", fmt::format("{} s is before the start", t), {}, "runs begin at 0");
  plan.energies = table.non_negative("energies", unit::time, end / 200);
  plan.checkpoints = table.non_negative("checkpoints", unit::time, end / 5);
  plan.checkpoint_wall_time = table.non_negative("checkpoint_wall_time", unit::time, 600);
  plan.report = table.flag("report", true) && options.report;
  std::vector<std::string> names;
  for (const auto& field : all_fields) names.emplace_back(field.name);
  for (const auto& name : table.choices("fields", names, {"v", "rho", "p", "m"}))
    plan.fields.push_back(static_cast<int>(std::ranges::find(names, name) - names.begin()));
  return plan;
}

bool due(double interval, double before, double now) {
  if (interval <= 0) return false;
  const auto index = [&](double t) { return std::floor(t / interval + 1e-9); };
  return before < 0 || index(now) > index(before);
}

std::string snapshot_due(const OutputPlan& plan, double before, double now) {
  if (due(plan.snapshots, before, now))
    return fmt::format("particles_{:06}.vtkhdf", std::llround(std::floor(now / plan.snapshots + 1e-9)));
  std::string name;
  const auto reached = [](double t, double wanted) { return t >= wanted * (1 - 1e-12); };
  for (const double t : plan.at)
    if (reached(now, t) && (before < 0 || !reached(before, t))) name = fmt::format("particles_at_{:g}s.vtkhdf", t);
  return name;
}

template <int N>
Frame frame_of(const Flow<N>& flow, std::int64_t step, const std::vector<int>& fields,
               std::vector<std::int32_t>& groups) {
  const Store<N>& store = flow.store();
  // Ghosts come last in the store, and are of use to nobody but the run itself.
  const bool ghosts = fields.empty() || !flow.options().mirrors;
  const std::size_t particles = ghosts ? store.size() : store.range(Group::fluid).size();
  Frame frame{.time = flow.time(), .step = step, .dimensions = N, .particles = particles};
  for (int f = 0; f < FieldId::count; ++f) {
    const bool wanted = fields.empty() || f == FieldId::x || std::ranges::count(fields, f) > 0;
    if (!wanted || !store.fields()[f]) continue;
    const FieldInfo& info = all_fields[f];
    frame.columns.push_back({std::string(info.name), std::string(info.unit == "1" ? "" : info.unit), info.components(N),
                             store.raw(f).data()});
  }
  groups.assign(store.size(), 0);
  const IndexRange wall = store.range(Group::wall);
  std::fill(groups.begin() + wall.begin, groups.begin() + wall.end, 1);
  frame.integers = {{std::string(identity_column), store.ids().data()},
                    {"material", store.materials().data()},
                    {"group", groups.data()}};
  return frame;
}

template <int N>
EnergySeries<N>::EnergySeries(const std::filesystem::path& folder, bool resume, double last_time)
    : series_(resume ? TimeSeries::resume(folder / "energies.csv", energy_columns(), last_time, energy_comments)
                     : TimeSeries::create(folder / "energies.csv", energy_columns(), energy_comments)) {}

template <int N>
void EnergySeries<N>::set_start(double total, double potential) {
  start_total_ = total;
  start_potential_ = potential;
}

template <int N>
double EnergySeries<N>::relative_residual(const Energies& e) const {
  const double scale = std::max({std::abs(start_potential_), std::abs(e.kinetic), std::abs(start_total_), 1e-300});
  return (e.total() - start_total_) / (start_potential_ > 0 ? start_potential_ : scale);
}

template <int N>
void EnergySeries<N>::add(const Flow<N>& flow, const Step& step, std::int64_t count) {
  const Energies e = flow.energies();
  const auto& l = e.ledger;
  const std::array row{flow.time(),
                       static_cast<double>(count),
                       step.dt,
                       e.kinetic,
                       e.potential,
                       e.elastic,
                       l.viscous,
                       l.artificial,
                       l.diffusion,
                       l.exchange,
                       l.walls,
                       l.xsph,
                       l.body,
                       e.total(),
                       e.total() - start_total_,
                       relative_residual(e),
                       e.strain_dissipated,
                       0.5 * e.strain_power};
  series_.add(row);
}

StepSeries::StepSeries(const std::filesystem::path& folder, bool resume, double last_time)
    : series_(resume ? TimeSeries::resume(folder / "steps.csv", step_columns(), last_time, step_comments())
                     : TimeSeries::create(folder / "steps.csv", step_columns(), step_comments())) {}

void StepSeries::add(double time, std::int64_t count, const Step& step, std::size_t fluid, std::size_t wall) {
  const auto limiter = std::ranges::find(step_limiters, step.limiter) - step_limiters.begin();
  series_.add(std::array{time, static_cast<double>(count), step.dt, static_cast<double>(limiter),
                         static_cast<double>(fluid), static_cast<double>(wall)});
}

void write_progress(const std::filesystem::path& folder, const std::string& text) {
  const auto file = folder / "progress.json", temporary = folder / "progress.json.tmp";
  if (std::ofstream stream(temporary); !(stream << text << '\n')) return;
  std::error_code ignored;
  std::filesystem::rename(temporary, file, ignored);
}

template Frame frame_of<1>(const Flow<1>&, std::int64_t, const std::vector<int>&, std::vector<std::int32_t>&);
template Frame frame_of<2>(const Flow<2>&, std::int64_t, const std::vector<int>&, std::vector<std::int32_t>&);
template Frame frame_of<3>(const Flow<3>&, std::int64_t, const std::vector<int>&, std::vector<std::int32_t>&);
template class EnergySeries<1>;
template class EnergySeries<2>;
template class EnergySeries<3>;

}  // namespace undine
