#include "undine/app/approximate/study.hpp"

#include <array>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "undine/app/run/options.hpp"
#include "undine/approximation/catalogue.hpp"
#include "undine/approximation/consistency.hpp"
#include "undine/core/error.hpp"
#include "undine/io/atomic_file.hpp"
#include "undine/io/case/document.hpp"
#include "undine/io/output_folder.hpp"
#include "undine/io/run_record.hpp"

namespace undine {
namespace {

using namespace approximation;

struct MethodOrder {
  std::string method;
  int order;
};

/// What is to be measured.
struct Wanted {
  StudyOptions options;
  std::string kernel;
  std::vector<MethodOrder> methods;
  std::vector<int> dimensions;
  std::string hash;  ///< of all keys
};

std::vector<MethodOrder> read_methods(const Table& root) {
  const std::string method = root.has("method") ? root.choice("method", Methods::names()) : std::string();
  const std::int64_t order = root.integer("order", -1);
  std::vector<MethodOrder> chosen;
  Methods::for_each([&]<class M>(M) {
    if (!method.empty() && M::info.name != method) return;
    for (int k = M::lowest_order; k <= M::highest_order; ++k)
      if (order < 0 || order == k) chosen.push_back({std::string(M::info.name), k});
  });
  if (chosen.empty())
    root.fail("order", fmt::format("'{}' has no order {}", method.empty() ? "every method" : method, order), {},
              "see `undine list approximations`");
  return chosen;
}

Wanted read_wanted(const std::vector<std::string>& sets) {
  Document document = Document::parse("", "--consistency");
  for (const std::string& each : sets) document.set(each);
  const Table root = document.root();
  Wanted wanted{.options = {}, .kernel = {}, .methods = read_methods(root), .dimensions = {}, .hash = {}};
  StudyOptions& options = wanted.options;
  wanted.kernel = root.choice("kernel", Kernels::names(), "wendland_c2");
  options.kernel = KernelChoice(Kernels::index_of(wanted.kernel));
  options.support = root.in_range("support", unit::one, {1.2, 8}, options.support);
  options.jitter = root.in_range("jitter", unit::one, {0, 0.5}, options.jitter);
  options.queries = static_cast<int>(root.in_range("queries", unit::one, {1, 1e5}, options.queries));
  options.seed = static_cast<std::uint64_t>(root.in_range("seed", unit::one, {1, 1e9}, 1.0));
  const std::int64_t dimensions = root.integer("dimensions", 0);
  if (dimensions < 0 || dimensions > 3)
    root.fail("dimensions", "dimensions must be 1, 2 or 3", {}, "choose one, or leave it out");
  for (int N = 1; N <= 3; ++N)
    if (dimensions == 0 || dimensions == N) wanted.dimensions.push_back(N);
  document.finish();
  wanted.hash = document.hash();
  return wanted;
}

const std::vector<std::string> polynomial_columns{
    "dimensions", "disordered",     "boundary",          "degree",           "value",     "gradient",
    "hessian",    "promised_value", "promised_gradient", "promised_hessian", "condition", "refused"};
const std::vector<std::string> refinement_columns{"dimensions", "disordered", "boundary",
                                                  "value",      "gradient",   "laplacian"};
const std::vector<std::string> end_columns{"distance", "one", "gradient_of_one", "x_error", "gradient_of_x"};

/// "1.3e-15", "2.01"; empty where there is no number.
std::string cell(double x) { return std::isnan(x) ? "" : fmt::format("{}", x); }

std::string line_of(const std::vector<std::string>& cells) { return fmt::format("{}\n", fmt::join(cells, ",")); }

/// A number that the method promises and does not give is infinitely wrong.
double promised_error(double error, int degree, int promised) {
  return degree <= promised && std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

std::string polynomial_lines(const StudyRow& row) {
  std::string lines;
  for (int d = 0; d < 3; ++d) {
    std::vector<std::string> cells{fmt::format("{}", row.dimensions),
                                   row.arrangement == Arrangement::disordered ? "1" : "0",
                                   row.place == Place::boundary ? "1" : "0", fmt::format("{}", d)};
    const auto k = static_cast<std::size_t>(d);
    cells.push_back(cell(promised_error(row.value[k], d, row.promised.value)));
    cells.push_back(cell(promised_error(row.gradient[k], d, row.promised.gradient)));
    cells.push_back(cell(promised_error(row.hessian[k], d, row.promised.hessian)));
    for (const int promised : {row.promised.value, row.promised.gradient, row.promised.hessian})
      cells.emplace_back(d <= promised ? "1" : "0");
    cells.push_back(cell(row.condition));
    cells.push_back(fmt::format("{}", row.refused));
    lines += line_of(cells);
  }
  return lines;
}

std::string refinement_line(const StudyRow& row) {
  return line_of({fmt::format("{}", row.dimensions), row.arrangement == Arrangement::disordered ? "1" : "0",
                  row.place == Place::boundary ? "1" : "0", cell(row.value_order), cell(row.gradient_order),
                  cell(row.laplacian_order)});
}

std::string text_line(const StudyRow& row) {
  const auto text = [](double x, const char* format) {
    return std::isnan(x) ? "" : fmt::format(fmt::runtime(format), x);
  };
  std::string line =
      fmt::format("{}-D {:26} {} {:10} {:8}", row.dimensions, row.method, row.order,
                  arrangement_words[static_cast<int>(row.arrangement)], place_words[static_cast<int>(row.place)]);
  for (const auto* errors : {&row.value, &row.gradient, &row.hessian}) {
    line += " |";
    for (const double e : *errors) line += fmt::format(" {:>7}", text(e, "{:.1e}"));
  }
  line += " |";
  for (const double rate : {row.value_order, row.gradient_order, row.laplacian_order})
    line += fmt::format(" {:>5}", text(rate, "{:.2f}"));
  return line + fmt::format(" | {:.1e}{}\n", row.condition, row.refused ? fmt::format(" {} refused", row.refused) : "");
}

std::vector<StudyRow> measure(const Wanted& wanted, const MethodOrder& which) {
  std::vector<StudyRow> rows;
  for (const int N : wanted.dimensions) {
    auto more = N == 1   ? consistency_study<1>(wanted.options, which.method, which.order)
                : N == 2 ? consistency_study<2>(wanted.options, which.method, which.order)
                         : consistency_study<3>(wanted.options, which.method, which.order);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

double points_of(const Wanted& wanted) {
  constexpr std::array<int, 3> points{study_points<1>, study_points<2>, study_points<3>};
  double sum = 0;
  for (const int N : wanted.dimensions) sum += points[static_cast<std::size_t>(N - 1)];
  return sum;
}

/// What a run would leave, so that a study can take its numbers.
void write(const std::filesystem::path& folder, const Wanted& wanted, const std::string& setting,
           const std::vector<StudyRow>& rows, double seconds) {
  const MethodOrder& which = wanted.methods.front();
  std::string polynomials = "# largest errors for monomials: " + setting + "\n" + line_of(polynomial_columns);
  std::string refinement = "# observed orders, spacing halved: " + setting + "\n" + line_of(refinement_columns);
  std::string ends = "# near the end x = 0 of a regular row of points, distance in H, slopes in 1/H: " + setting +
                     "\n" + line_of(end_columns);
  for (const StudyRow& row : rows) {
    polynomials += polynomial_lines(row);
    refinement += refinement_line(row);
  }
  for (const EndRow& row : end_of_support(wanted.options, which.method, which.order))
    ends += line_of({fmt::format("{:.1f}", row.distance), cell(row.one), cell(row.gradient_of_one), cell(row.x_error),
                     cell(row.gradient_of_x)});
  const FolderClaim claim = prepare_output_folder(folder, FolderMode::overwrite);
  std::filesystem::create_directories(folder / "gauges");
  write_text_atomically(folder / "gauges" / "polynomials.csv", polynomials);
  write_text_atomically(folder / "gauges" / "refinement.csv", refinement);
  write_text_atomically(folder / "gauges" / "end_of_support.csv", ends);
  write_json(folder / "run.json", Json{{"program", "undine"},
                                       {"version", program_version()},
                                       {"status", "finished"},
                                       {"measured", setting},
                                       {"particles", {{"fluid", points_of(wanted)}, {"wall", 0}}},
                                       {"time", 0},
                                       {"steps", 0},
                                       {"seconds", {{"total", seconds}}},
                                       {"particle_updates_per_s", 0}});
}

}  // namespace

int run_consistency(const ApproximateOptions& options) {
  if (!options.points.empty())
    throw InputError({.what = "--consistency makes its own points", .fix = "leave the file out"});
  const Wanted wanted = read_wanted(options.sets);
  if (!options.out.empty() && wanted.methods.size() != 1)
    throw InputError({.what = "--out takes the measurement of one method and order",
                      .why = fmt::format("{} are chosen", wanted.methods.size()),
                      .fix = "add --set method=rkpm --set order=1; studies/consistency.toml has all of them"});
  const std::string setting = fmt::format(
      "{}kernel {}, H = {} spacings, disordered points moved by at most {} spacings",
      options.out.empty() ? "" : fmt::format("{} of order {}, ", wanted.methods[0].method, wanted.methods[0].order),
      wanted.kernel, wanted.options.support, wanted.options.jitter);
  fmt::print(
      "{}\nlargest errors for monomials of degree 0, 1, 2 | of the gradient | of the Hessian | observed order of "
      "value, gradient, Laplacian | condition\n",
      setting);
  const auto start = std::chrono::steady_clock::now();
  std::vector<StudyRow> rows;
  for (const MethodOrder& which : wanted.methods) {
    rows = measure(wanted, which);
    for (const StudyRow& row : rows) fmt::print("{}", text_line(row));
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (!options.out.empty()) write(options.out, wanted, setting, rows, seconds.count());
  return exit_ok;
}

CaseOutline outline_consistency(const std::vector<std::string>& sets) {
  const Wanted wanted = read_wanted(sets);
  CaseOutline outline{.hash = wanted.hash,
                      .dimensions = wanted.dimensions.back(),
                      .spacing = 1,
                      .support = wanted.options.support,
                      .end = 1,
                      .step = 1,
                      .fluid = points_of(wanted),
                      .series = {},
                      .warnings = {}};
  const auto add = [&](const char* name, const std::vector<std::string>& columns) {
    std::vector<SeriesColumn> all;
    for (const std::string& column : columns) all.push_back({column});
    outline.series.emplace_back(name, std::move(all));
  };
  add("polynomials", polynomial_columns);
  add("refinement", refinement_columns);
  add("end_of_support", end_columns);
  return outline;
}

}  // namespace undine
