#include <cmath>

#include <fmt/format.h>

#include "undine/app/approximate.hpp"
#include "undine/app/run_options.hpp"
#include "undine/approximation/consistency.hpp"
#include "undine/core/error.hpp"
#include "undine/core/nearest.hpp"
#include "undine/io/atomic_file.hpp"

namespace undine {
namespace {

using namespace approximation;

/// "1.3e-15", "2.01"; empty where there is no number.
std::string cell(double x, const char* format) { return std::isnan(x) ? "" : fmt::format(fmt::runtime(format), x); }

constexpr const char* header =
    "dimensions,method,order,points,place,value_0,value_1,value_2,gradient_0,gradient_1,gradient_2,"
    "hessian_0,hessian_1,hessian_2,value_rate,gradient_rate,laplacian_rate,condition,refused\n";

std::string csv_line(const StudyRow& row) {
  std::string line =
      fmt::format("{},{},{},{},{}", row.dimensions, row.method, row.order,
                  arrangement_words[static_cast<int>(row.arrangement)], place_words[static_cast<int>(row.place)]);
  for (const auto* errors : {&row.value, &row.gradient, &row.hessian})
    for (const double e : *errors) line += "," + cell(e, "{:.1e}");
  for (const double rate : {row.value_order, row.gradient_order, row.laplacian_order})
    line += "," + cell(rate, "{:.2f}");
  return line + fmt::format(",{:.1e},{}\n", row.condition, row.refused);
}

std::string text_line(const StudyRow& row) {
  std::string line =
      fmt::format("{}-D {:26} {} {:10} {:8}", row.dimensions, row.method, row.order,
                  arrangement_words[static_cast<int>(row.arrangement)], place_words[static_cast<int>(row.place)]);
  for (const auto* errors : {&row.value, &row.gradient, &row.hessian}) {
    line += " |";
    for (const double e : *errors) line += fmt::format(" {:>7}", cell(e, "{:.1e}"));
  }
  line += " |";
  for (const double rate : {row.value_order, row.gradient_order, row.laplacian_order})
    line += fmt::format(" {:>5}", cell(rate, "{:.2f}"));
  return line + fmt::format(" | {:.1e}{}\n", row.condition, row.refused ? fmt::format(" {} refused", row.refused) : "");
}

}  // namespace

int run_consistency_study(const ApproximateOptions& options) {
  const int kernel = Kernels::index_of(options.kernel);
  if (kernel < 0)
    throw InputError({.what = fmt::format("there is no kernel '{}'", shortened(options.kernel, 60)),
                      .fix = did_you_mean(options.kernel, Kernels::names()) + " see `undine list kernels`"});
  if (!options.points.empty())
    throw InputError({.what = "--consistency makes its own points", .fix = "leave the file out"});
  const StudyOptions study{.kernel = KernelChoice(kernel)};
  const std::string setting = fmt::format("kernel {}, H = {} spacings, disordered points moved by at most {} spacings",
                                          options.kernel, study.support, study.jitter);
  fmt::print(
      "{}\nlargest errors for monomials of degree 0, 1, 2 | of the gradient | of the Hessian | observed order of "
      "value, gradient, Laplacian | condition\n",
      setting);
  std::string table = "# undine approximate --consistency: " + setting + "\n" + header;
  const auto take = [&](const std::vector<StudyRow>& rows) {
    for (const auto& row : rows) {
      table += csv_line(row);
      fmt::print("{}", text_line(row));
    }
  };
  take(consistency_study<1>(study));
  take(consistency_study<2>(study));
  take(consistency_study<3>(study));

  std::string ends = "# undine approximate --consistency: near the end x = 0 of a row of points, " + setting +
                     "\nmethod,order,distance,one,gradient_of_one,x_error,gradient_of_x\n";
  fmt::print(
      "\nnear the end of a row of points, at distance d [H]: estimates of 1, its slope [1/H], (<x> - x)/H, dx/dx\n");
  for (const auto& row : end_of_support(study)) {
    ends += fmt::format("{},{},{:.1f},{:.6f},{:.6f},{:.6f},{:.6f}\n", row.method, row.order, row.distance, row.one,
                        row.gradient_of_one, row.x_error, row.gradient_of_x);
    fmt::print("{:8} {} {:.1f} {:9.4f} {:9.4f} {:9.4f} {:9.4f}\n", row.method, row.order, row.distance, row.one,
               row.gradient_of_one, row.x_error, row.gradient_of_x);
  }
  if (options.out.empty()) return exit_ok;
  std::error_code failure;
  std::filesystem::create_directories(options.out, failure);
  if (failure)
    throw InputError(
        {.what = fmt::format("the folder '{}' cannot be made", options.out.string()), .why = failure.message()});
  write_text_atomically(options.out / "polynomials.csv", table);
  write_text_atomically(options.out / "end_of_support.csv", ends);
  return exit_ok;
}

}  // namespace undine
