#include "undine/app/gauges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "undine/core/nearest.hpp"
#include "undine/engine/interpolate.hpp"

namespace undine {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::vector<std::string> all_axes{"x", "y", "z"};

template <int N>
const std::vector<std::string>& axes() {
  static const std::vector<std::string> words(all_axes.begin(), all_axes.begin() + N);
  return words;
}

/// Index of the axis that a key names.
template <int N>
int read_axis(const Table& table, int fallback) {
  const std::string word = table.choice("axis", axes<N>(), axes<N>()[static_cast<std::size_t>(fallback)]);
  return word[0] - 'x';
}

template <int N>
Vec<N> read_point(const Table& table, std::string_view key, std::optional<Vec<N>> fallback = {}) {
  const std::vector<double> numbers =
      fallback ? table.quantities(key, unit::length, N, std::vector<double>(fallback->c, fallback->c + N))
               : table.quantities(key, unit::length, N);
  Vec<N> point;
  for (int k = 0; k < N; ++k) point[k] = numbers[static_cast<std::size_t>(k)];
  return point;
}

template <int N>
InterpolationSource<N> source_of(const WeaklyCompressible<N>& flow) {
  Support support = flow.options().support;
  support.per_particle = flow.options().rho_law;
  return {flow.store(), flow.neighbours(), flow.domain(),
          flow.options().kernels[static_cast<std::size_t>(KernelRole::density)], support};
}

template <int N>
class Probe : public Gauge<N> {
 public:
  static constexpr Info info{"probe", "Pressure, velocity or density at a point",
                             "f(x) = sum_b V_b f_b W_b / sum_b V_b W_b; 0 where sum_b V_b W_b < wet", "Shepard (1968)"};

  Probe(const Table& table, const GaugeContext<N>& context)
      : at_(read_point<N>(table, "at")),
        fields_(table.choices("fields", {"pressure", "velocity", "density"}, {"pressure"})),
        shepard_(table.flag("shepard", true)),
        wet_(table.in_range("wet", unit::one, {0, 1}, 0.1)) {
    if (!context.domain.contains(at_))
      table.fail("at", "the probe is outside the domain", "no particle can come there", "move it, or widen [domain]");
    if (fields_.empty()) table.fail("fields", "the probe reads nothing", {}, "name a field, such as \"pressure\"");
  }

  std::vector<SeriesColumn> columns() const override {
    std::vector<SeriesColumn> all;
    for (const std::string& field : fields_) {
      if (field == "pressure") all.push_back({"p", "Pa"});
      if (field == "density") all.push_back({"rho", "kg/m^3"});
      if (field == "velocity")
        for (const std::string& axis : axes<N>()) all.push_back({"v" + axis, "m/s"});
    }
    return all;
  }

  std::vector<double> read(const WeaklyCompressible<N>& flow) const override {
    Interpolated<N> here = interpolate(source_of(flow), at_);
    if (here.weight < wet_) here = {};  // a sensor in the air, with a drop on it at most
    const double scale = shepard_ ? 1 : here.weight;
    std::vector<double> row;
    for (const std::string& field : fields_) {
      if (field == "pressure") row.push_back(scale * here.p);
      if (field == "density") row.push_back(scale * here.rho);
      if (field == "velocity")
        for (int k = 0; k < N; ++k) row.push_back(scale * here.v[k]);
    }
    return row;
  }

 private:
  Vec<N> at_;
  std::vector<std::string> fields_;
  bool shepard_;
  double wet_;
};

/// A point is wet where the fluid fills more than half of that part of the kernel which walls leave free:
///   sum V W (fluid) > 1/2 share,  share = 1 - sum V W (walls)
/// so that the surface of still water is found where it is, also next to walls, where the kernel can never be full.
/// Walls without (enough) particles are seen by the column's end alone: within H/2 of `from`, the share is at most
/// 1/2 + s/H at distance s. Still water reads its depth within 0.5 spacings. A point is inside a wall, and dry, if the
/// walls take 0.8 of the kernel: an edge between two walls takes 3/4. In a corner of three (7/8) the wetted length is
/// therefore up to 0.75 spacings short.
template <int N>
class Height : public Gauge<N> {
 public:
  static constexpr Info info{
      "height", "Height of water along a column",
      "wetted: summed length where sum_b V_b W_b > share/2; surface: where the highest such part ends",
      "threshold at the middle of a flat surface"};

  Height(const Table& table, const GaugeContext<N>& context) : at_(read_point<N>(table, "at")) {
    int steepest = N - 1;
    for (int k = 0; k < N; ++k)
      if (std::abs(context.gravity[k]) > std::abs(context.gravity[steepest])) steepest = k;
    axis_ = read_axis<N>(table, steepest);
    const bool down = context.gravity[axis_] > 0;  // gravity along +axis: the column rises along -axis
    from_ = read_end(table, "from", down ? context.domain.high[axis_] : context.domain.low[axis_]);
    to_ = read_end(table, "to", down ? context.domain.low[axis_] : context.domain.high[axis_]);
    const double intervals = std::ceil(std::abs(to_ - from_) / (context.spacing / 4));
    if (!(intervals > 0 && intervals < 1e6))
      table.fail(
          "to", "the column has no sensible length",
          fmt::format("it is {:.6g} m long, the particles are {:.6g} m apart", std::abs(to_ - from_), context.spacing),
          "give the two ends of the column, 'from' and 'to'");
    intervals_ = static_cast<std::size_t>(intervals);
    surface_ = table.choice("mode", {"wetted", "surface"}, "wetted") == "surface";
  }

  std::vector<SeriesColumn> columns() const override { return {{"height", "m"}}; }

  std::vector<double> read(const WeaklyCompressible<N>& flow) const override {
    const auto source = source_of(flow);
    const double step = std::abs(to_ - from_) / static_cast<double>(intervals_);
    double wetted = 0, surface = 0;
    double below = wetness(source, 0);
    for (std::size_t k = 1; k <= intervals_; ++k) {
      const double s = step * static_cast<double>(k);
      const double above = wetness(source, s);
      const double crossing = (below > 0) != (above > 0) ? step * below / (below - above) : 0;  // from the lower end
      if (below > 0) {
        wetted += above > 0 ? step : crossing;
        surface = above > 0 ? s : s - step + crossing;
      } else if (above > 0) {
        wetted += step - crossing;
        surface = s;
      }
      below = above;
    }
    return {surface_ ? surface : wetted};
  }

 private:
  static double read_end(const Table& table, std::string_view key, double fallback) {
    return std::isfinite(fallback) ? table.quantity(key, unit::length, fallback) : table.quantity(key, unit::length);
  }

  /// Positive where the point at distance s from `from` is wet.
  double wetness(const InterpolationSource<N>& source, double s) const {
    Vec<N> x = at_;
    x[axis_] = from_ + std::copysign(s, to_ - from_);
    const double walls = wall_share(source, x);
    if (walls > 0.8) return -0.5;
    const double share = std::min(1 - walls, 0.5 + s / source.support.uniform);
    return fluid_share(source, x) - 0.5 * share;
  }

  Vec<N> at_;
  int axis_ = 0;
  double from_ = 0, to_ = 0;
  std::size_t intervals_ = 0;
  bool surface_ = false;
};

template <int N>
class WallForce : public Gauge<N> {
 public:
  static constexpr Info info{"wall_force", "Force and moment of the fluid on the walls, or on one of them",
                             "F = sum_w m_w acc_w, M = sum_w (x_w - about) x m_w acc_w; in 2-D for 1 m of width",
                             "reaction to the forces of walls on the fluid"};

  WallForce(const Table& table, const GaugeContext<N>& context)
      : where_(table.where()), about_(read_point<N>(table, "about", Vec<N>{})) {
    if (context.bodies.empty() && !context.body_of_id.empty())
      table.fail("type", "there are no wall particles to push on", "force is summed over wall particles",
                 "choose a wall treatment with particles, or leave this gauge out");
    if (!table.has("wall")) return;
    std::vector<std::string> names;
    for (const auto& [name, body] : context.bodies) names.push_back(name);
    if (names.empty()) table.fail("wall", "no wall of this case has a name", {}, "name it there, or leave out 'wall'");
    const int body = context.bodies.at(table.choice("wall", names));
    one_body_ = true;
    for (const int each : context.body_of_id) of_body_.push_back(each == body);
  }

  bool needs_wall_forces() const override { return true; }

  std::vector<SeriesColumn> columns() const override {
    std::vector<SeriesColumn> all;
    for (const std::string& axis : axes<N>()) all.push_back({"f" + axis, "N"});
    for (int k = first_moment; k < 3; ++k) all.push_back({"m" + all_axes[static_cast<std::size_t>(k)], "N m"});
    return all;
  }

  std::vector<double> read(const WeaklyCompressible<N>& flow) const override {
    const auto x = flow.store().template get<field::x>();
    const auto m = flow.store().template get<field::m>();
    const auto acc = flow.store().template get<field::acc>();
    const auto ids = flow.store().ids();
    const Total total = total_over(flow.store(), Group::wall, [&](std::size_t i) {
      const auto id = static_cast<std::size_t>(ids[i]);
      if (one_body_ && !(id < of_body_.size() && of_body_[id])) return Total{};
      const Vec<N> force = m[i] * acc[i];
      return Total{force, cross(in_3d(x[i] - about_), in_3d(force)), 1};
    });
    if (total.particles == 0 || flow.options().wall_density == walls::WallDensity::none)
      throw InputError(
          {.what = "this gauge finds no wall particles to measure the force on",
           .where = where_,
           .why = "only walls made of particles that press on the fluid feel a force",
           .fix = "choose such walls ('combined', 'wall_particles', 'modified_density') or remove the gauge"});
    std::vector<double> row(total.force.c, total.force.c + N);
    row.insert(row.end(), total.moment.c + first_moment, total.moment.c + 3);
    return row;
  }

 private:
  static constexpr int first_moment = N == 3 ? 0 : N == 2 ? 2 : 3;

  struct Total {
    Vec<N> force{};
    Vec<3> moment{};
    double particles = 0;
    Total& operator+=(const Total& o) {
      force += o.force;
      moment += o.moment;
      particles += o.particles;
      return *this;
    }
  };

  static Vec<3> in_3d(const Vec<N>& a) {
    Vec<3> b;
    for (int k = 0; k < N; ++k) b[k] = a[k];
    return b;
  }

  SourceLocation where_;
  Vec<N> about_;
  bool one_body_ = false;
  std::vector<char> of_body_;  ///< by particle id
};

template <int N>
class Front : public Gauge<N> {
 public:
  static constexpr Info info{
      "front", "How far the fluid reaches along an axis",
      "largest (sign +) or smallest (sign -) coordinate of the fluid's particles, but for some foremost ones", ""};

  Front(const Table& table, const GaugeContext<N>&)
      : axis_(read_axis<N>(table, 0)),
        sign_(table.choice("sign", {"+", "-"}, "+") == "+" ? 1 : -1),
        ignore_(table.integer("ignore", 0)) {
    if (ignore_ < 0) table.fail("ignore", "'ignore' is a number of particles", "it is negative", "give 0 or more");
  }

  std::vector<SeriesColumn> columns() const override { return {{"front", "m"}}; }

  std::vector<double> read(const WeaklyCompressible<N>& flow) const override {
    const IndexRange fluid = flow.store().range(Group::fluid);
    const auto ignored = static_cast<std::size_t>(ignore_);
    if (ignored >= fluid.size()) return {nan};
    const auto x = flow.store().template get<field::x>();
    std::vector<double> reach;
    for (std::size_t i = fluid.begin; i < fluid.end; ++i) reach.push_back(sign_ * flow.domain().wrapped(x[i])[axis_]);
    const auto front = reach.begin() + static_cast<std::ptrdiff_t>(ignored);
    std::nth_element(reach.begin(), front, reach.end(), std::greater<>());
    return {sign_ * *front};
  }

 private:
  int axis_;
  double sign_;
  std::int64_t ignore_;
};

template <int N>
class Extremes : public Gauge<N> {
 public:
  static constexpr Info info{"extremes", "Largest speed; smallest and largest density and pressure of the fluid",
                             "max |v|, min rho, max rho, min p, max p", ""};

  Extremes(const Table&, const GaugeContext<N>&) {}

  std::vector<SeriesColumn> columns() const override {
    return {{"v_max", "m/s"}, {"rho_min", "kg/m^3"}, {"rho_max", "kg/m^3"}, {"p_min", "Pa"}, {"p_max", "Pa"}};
  }

  std::vector<double> read(const WeaklyCompressible<N>& flow) const override {
    if (flow.store().range(Group::fluid).size() == 0) return {nan, nan, nan, nan, nan};
    const auto v = flow.store().template get<field::v>();
    const auto rho = flow.store().template get<field::rho>();
    const auto p = flow.store().template get<field::p>();
    const auto largest = [&](auto&& f) {
      return largest_over(flow.store(), Group::fluid, -std::numeric_limits<double>::infinity(), f);
    };
    return {largest([&](std::size_t i) { return norm(v[i]); }), -largest([&](std::size_t i) { return -rho[i]; }),
            largest([&](std::size_t i) { return rho[i]; }), -largest([&](std::size_t i) { return -p[i]; }),
            largest([&](std::size_t i) { return p[i]; })};
  }
};

/// The one list of gauge types.
template <int N>
using GaugeTypes = Catalogue<  //
    Probe<N>,                  //
    Height<N>,                 //
    WallForce<N>,              //
    Front<N>,                  //
    Extremes<N>>;

template <int N, class... Types>
std::unique_ptr<Gauge<N>> make_gauge(Catalogue<Types...> types, const Table& table, const GaugeContext<N>& context) {
  const std::string type = table.choice("type", types.names());
  std::unique_ptr<Gauge<N>> gauge;
  ((type == Types::info.name ? void(gauge = std::make_unique<Types>(table, context)) : void()), ...);
  return gauge;
}

/// Which multiple of `every` was passed last. A function of the time alone, so that a resumed run samples as an
/// unbroken one.
double due_index(double time, double every) { return std::floor(time / every + 1e-9); }

/// A column of published data, by the name in the case file, or else column number k.
const CsvColumn& find_column(const Table& table, std::string_view key, const CsvTable& data, std::size_t k) {
  std::vector<std::string> names;
  for (const CsvColumn& column : data.columns) names.push_back(column.name);
  const std::string name = k < names.size() ? table.text(key, names[k]) : table.text(key);
  if (const CsvColumn* found = data.find(name)) return *found;
  table.fail(key, fmt::format("'{}' has no column '{}'", data.path.string(), name),
             fmt::format("its columns are: {}", listed(names)), did_you_mean(name, names));
}

/// The values of a series that are finite.
Samples finite(const Samples& all) {
  Samples kept;
  for (std::size_t k = 0; k < all.times.size(); ++k) {
    if (!std::isfinite(all.times[k]) || !std::isfinite(all.values[k])) continue;
    kept.times.push_back(all.times[k]);
    kept.values.push_back(all.values[k]);
  }
  return kept;
}

/// The part of a series with first <= time <= last.
Samples between(const Samples& all, double first, double last) {
  Samples kept;
  for (std::size_t k = 0; k < all.times.size(); ++k) {
    if (all.times[k] < first || all.times[k] > last) continue;
    kept.times.push_back(all.times[k]);
    kept.values.push_back(all.values[k]);
  }
  return kept;
}

/// Linear between samples; the time is within their range.
double value_at(const Samples& series, double time) {
  const auto above = std::ranges::lower_bound(series.times, time);
  const auto k = static_cast<std::size_t>(above - series.times.begin());
  if (k == 0 || *above == time) return series.values[k];
  const double part = (time - series.times[k - 1]) / (series.times[k] - series.times[k - 1]);
  return (1 - part) * series.values[k - 1] + part * series.values[k];
}

void find_peak(const Samples& series, double& value, double& time) {
  value = time = nan;
  if (series.times.empty()) return;
  const auto peak = std::ranges::max_element(series.values);
  value = *peak;
  time = series.times[static_cast<std::size_t>(peak - series.values.begin())];
}

}  // namespace

Comparison compare(const Samples& ours, const Samples& reference, double until) {
  const Samples all = finite(ours);
  Comparison result;
  Samples theirs;
  if (!all.times.empty()) theirs = between(finite(reference), all.times.front(), std::min(until, all.times.back()));
  result.points = theirs.times.size();
  find_peak(theirs, result.reference_peak, result.reference_peak_time);
  result.rms = result.range = result.relative = result.peak = result.peak_time = nan;
  if (result.points == 0) return result;
  const auto [first, last] = std::ranges::minmax(theirs.times);
  find_peak(between(all, first, last), result.peak, result.peak_time);
  const auto [least, most] = std::ranges::minmax(theirs.values);
  double sum = 0;
  for (std::size_t k = 0; k < result.points; ++k) sum += sq(value_at(all, theirs.times[k]) - theirs.values[k]);
  result.rms = std::sqrt(sum / static_cast<double>(result.points));
  result.range = most - least;
  result.relative = result.range > 0 ? result.rms / result.range : nan;
  return result;
}

std::string comparison_table(std::span<const Comparison> comparisons) {
  if (comparisons.empty()) return {};
  std::vector<std::vector<std::string>> rows{
      {"gauge", "column", "points", "rms", "range", "rms/range", "peak", "at", "reference peak", "at"}};
  const auto number = [](double value, std::string_view unit) {
    return std::isfinite(value) ? fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit) : std::string("-");
  };
  for (const Comparison& c : comparisons)
    rows.push_back({c.gauge, c.column, std::to_string(c.points), number(c.rms, c.unit), number(c.range, c.unit),
                    std::isfinite(c.relative) ? fmt::format("{:.1f} %", 100 * c.relative) : "-", number(c.peak, c.unit),
                    number(c.peak_time, "s"), number(c.reference_peak, c.unit), number(c.reference_peak_time, "s")});
  std::vector<std::size_t> widths(rows[0].size());
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k)
      text += k < 2 ? fmt::format("{:<{}}  ", row[k], widths[k]) : fmt::format("{:>{}}  ", row[k], widths[k]);
    text.resize(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return text;
}

std::vector<Info> gauge_infos() {
  std::vector<Info> all;
  for (int k = 0; k < GaugeTypes<3>::size; ++k) all.push_back(GaugeTypes<3>::info(k));
  return all;
}

template <int N>
GaugeSet<N>::GaugeSet(const Table& root, const GaugeContext<N>& context) {
  std::set<std::string> names;
  for (const Table& table : root.tables("gauge")) {
    entries_.push_back(read_entry(table, context));
    const std::string& name = entries_.back().name;
    if (!names.insert(name).second)
      table.fail("name", fmt::format("two gauges are called '{}'", name), "each writes the file NAME.csv",
                 "rename one");
  }
}

template <int N>
auto GaugeSet<N>::read_entry(const Table& table, const GaugeContext<N>& context) -> Entry {
  Entry entry{.name = table.text("name"),
              .every = table.positive("every", unit::time, context.interval),
              .gauge = make_gauge(GaugeTypes<N>{}, table, context),
              .reference = {},
              .path = {},
              .series = {}};
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
  };
  if (entry.name.empty() || entry.name[0] == '.' || !std::ranges::all_of(entry.name, fits))
    table.fail("name", fmt::format("'{}' cannot name a gauge", shortened(entry.name, 40)),
               "it becomes a file name, NAME.csv", "use letters, digits, '_', '-' and '.'");
  const Table reference = table.table("reference");
  if (reference.exists()) entry.reference = read_reference(reference, entry.gauge->columns());
  return entry;
}

template <int N>
auto GaugeSet<N>::read_reference(const Table& table, const std::vector<SeriesColumn>& columns) -> Reference {
  const fs::path file = table.path("file");
  if (!fs::is_regular_file(file))
    table.fail("file", fmt::format("there is no file '{}'", file.string()), {},
               "names are relative to the case file's folder");
  const CsvTable data = read_csv(file);
  const CsvColumn& time = find_column(table, "time", data, 0);
  const CsvColumn& value = find_column(table, "value", data, 1);
  std::vector<std::string> names;
  for (const SeriesColumn& column : columns) names.push_back(column.name);
  Reference reference{table.choice("column", names, names.front()), {time.values, value.values}, 0};
  reference.until = table.has("until") ? table.positive("until", unit::time) : std::numeric_limits<double>::infinity();

  const auto check_unit = [&](const CsvColumn& column, const std::string& ours, std::string_view scale) {
    if (!column.unit.empty() && column.unit != ours && !table.has(scale))
      table.fail("file", fmt::format("column '{}' is in {}, not in {}", column.name, column.unit, ours), {},
                 fmt::format("give '{}', the factor from one to the other (1 if they are the same)", scale));
  };
  check_unit(time, "s", "time_scale");
  check_unit(value, std::ranges::find(columns, reference.column, &SeriesColumn::name)->unit, "scale");
  const double scale = table.number("scale", 1.0), shift = table.number("shift", 0.0);
  const double time_scale = table.positive("time_scale", unit::one, 1.0);
  const double time_shift = table.quantity("time_shift", unit::time, 0.0);
  for (double& each : reference.samples.values) each = each * scale + shift;
  for (double& each : reference.samples.times) each = each * time_scale + time_shift;
  if (finite(reference.samples).times.empty())
    table.fail("file", fmt::format("'{}' has no numbers in '{}' and '{}'", file.string(), time.name, value.name));
  return reference;
}

template <int N>
std::vector<SeriesColumn> GaugeSet<N>::file_columns(const Gauge<N>& gauge) {
  std::vector<SeriesColumn> columns{{"time", "s"}};
  for (SeriesColumn& column : gauge.columns()) columns.push_back(std::move(column));
  return columns;
}

template <int N>
void GaugeSet<N>::set_paths(const fs::path& folder) {
  if (entries_.empty()) return;
  std::error_code failure;
  fs::create_directories(folder / "gauges", failure);
  if (failure)
    throw Error(
        {.what = fmt::format("cannot make the folder '{}'", (folder / "gauges").string()), .why = failure.message()});
  for (Entry& entry : entries_) entry.path = folder / "gauges" / (entry.name + ".csv");
  write_references(folder / "gauges" / "reference");
}

template <int N>
void GaugeSet<N>::write_references(const fs::path& folder) const {
  std::error_code failure;
  fs::remove_all(folder, failure);
  for (const Entry& entry : entries_) {
    if (!entry.reference) continue;
    fs::create_directories(folder, failure);
    const auto columns = file_columns(*entry.gauge);
    const auto column = std::ranges::find(columns, entry.reference->column, &SeriesColumn::name);
    TimeSeries file = TimeSeries::create(folder / (entry.name + ".csv"), {columns.front(), *column});
    const Samples compared =
        between(finite(entry.reference->samples), -std::numeric_limits<double>::infinity(), entry.reference->until);
    for (std::size_t k = 0; k < compared.times.size(); ++k) file.add(std::array{compared.times[k], compared.values[k]});
  }
}

template <int N>
void GaugeSet<N>::create(const fs::path& folder) {
  set_paths(folder);
  for (Entry& entry : entries_) {
    entry.series = TimeSeries::create(entry.path, file_columns(*entry.gauge));
    entry.last = -1;
  }
}

template <int N>
void GaugeSet<N>::resume(const fs::path& folder, double last_time) {
  set_paths(folder);
  for (Entry& entry : entries_) {
    entry.series = TimeSeries::resume(entry.path, file_columns(*entry.gauge), last_time);
    const CsvTable kept = read_csv(entry.path);
    entry.last = kept.rows == 0 ? -1 : due_index(kept.columns[0].values.back(), entry.every);
  }
}

template <int N>
void GaugeSet<N>::sample(WeaklyCompressible<N>& flow) {
  const double time = flow.time();
  bool forces_known = false;
  for (Entry& entry : entries_) {
    const double due = due_index(time, entry.every);
    if (!(due > entry.last)) continue;
    if (!entry.series) throw Error({.what = "gauges were sampled before they had a folder to write to"});
    if (entry.gauge->needs_wall_forces() && !forces_known) {
      flow.evaluate_wall_forces();
      forces_known = true;
    }
    std::vector<double> row{time};
    for (const double value : entry.gauge->read(flow)) row.push_back(value);
    entry.series->add(row);
    entry.last = due;
  }
}

template <int N>
std::vector<Comparison> GaugeSet<N>::compare() const {
  std::vector<Comparison> all;
  for (const Entry& entry : entries_) {
    if (!entry.reference || !entry.series) continue;
    const CsvTable file = read_csv(entry.path);
    const CsvColumn& column = file.column(entry.reference->column);
    all.push_back(
        undine::compare({file.columns[0].values, column.values}, entry.reference->samples, entry.reference->until));
    all.back().gauge = entry.name;
    all.back().column = column.name;
    all.back().unit = column.unit;
  }
  return all;
}

template class GaugeSet<1>;
template class GaugeSet<2>;
template class GaugeSet<3>;

}  // namespace undine
