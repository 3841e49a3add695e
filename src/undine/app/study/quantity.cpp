#include "undine/app/study/quantity.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "undine/core/nearest.hpp"

namespace undine::study {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<std::string> take_words{"last",   "first",       "max",  "min",    "mean",    "rms",
                                          "growth", "growth_rate", "rise", "ripple", "time_to", "deviation"};

/// A time in s, or nothing for the end that is open.
double read_time(const Table& table, const char* key, double open) {
  return table.has(key) ? table.quantity(key, unit::time) : open;
}

Expression::Variables names_of(const CsvTable& file) {
  Expression::Variables names;
  for (const CsvColumn& column : file.columns) names.push_back(column.name);
  return names;
}

/// A formula of the columns, row by row.
std::vector<double> evaluate_rows(const Expression& formula, const CsvTable& file) {
  std::vector<double> all, row(file.columns.size());
  for (std::size_t r = 0; r < file.rows; ++r) {
    for (std::size_t c = 0; c < row.size(); ++c) row[c] = file.columns[c].values[r];
    all.push_back(formula.evaluate(row));
  }
  return all;
}

ReferenceSeries read_reference(const Table& table, bool relative) {
  const auto path = table.path("file");
  if (!std::filesystem::is_regular_file(path))
    table.fail("file", fmt::format("there is no file '{}'", path.string()), {},
               "names are relative to the study file's folder");
  const CsvTable file = read_csv(path);
  const auto x = evaluate_rows(table.formula("x", names_of(file)), file);
  const auto y = evaluate_rows(table.formula("y", names_of(file)), file);
  const double from = table.number("from", -1e300), to = table.number("to", 1e300);
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < x.size(); ++k)
    if (std::isfinite(x[k]) && std::isfinite(y[k]) && x[k] >= from && x[k] <= to) rows.push_back(k);
  std::ranges::stable_sort(rows, {}, [&](std::size_t k) { return x[k]; });
  ReferenceSeries reference{
      .x = {}, .y = {}, .shift = table.in_range("shift", unit::one, {0, 1e300}, 0.0), .relative = relative};
  for (const std::size_t k : rows) {
    reference.x.push_back(x[k]);
    reference.y.push_back(y[k]);
  }
  if (rows.size() < 2)
    table.fail("file", fmt::format("'{}' has {} points between 'from' and 'to'", path.string(), rows.size()), {},
               "two or more are needed");
  return reference;
}

void read_series(const Table& table, Quantity& quantity) {
  quantity.series = table.has("gauge") ? table.text("gauge") : "energies";
  quantity.take =
      static_cast<Take>(std::ranges::find(take_words, table.choice("take", take_words, "last")) - take_words.begin());
  quantity.end = infinity;
  if (quantity.take != Take::deviation) {  // whose window is that of its reference
    quantity.start = read_time(table, "start", 0);
    quantity.end = read_time(table, "end", infinity);
  }
  if (quantity.end < quantity.start)
    table.fail("end", "the window ends before it starts", {}, "make 'end' larger than 'start'");
  if (quantity.take == Take::ripple) quantity.period = table.positive("period", unit::time);
  if (quantity.take == Take::time_to) {
    quantity.above = table.has("above");
    if (quantity.above == table.has("below"))
      table.fail("take", "time_to needs one of 'above' and 'below'", {}, "give the threshold as above = or below =");
    quantity.threshold = table.number(quantity.above ? "above" : "below");
    quantity.stays = table.flag("stays", false);
  }
  if (quantity.take == Take::deviation)
    quantity.reference = read_reference(table.table("reference"), table.flag("relative", true));
  // Read as formulas once the columns of the file are known.
  (void)table.text("column");
  if (quantity.reference && table.has("abscissa")) (void)table.text("abscissa");
}

}  // namespace

const std::vector<std::string>& RunFacts::names() {
  static const std::vector<std::string> all{"time",      "steps", "particles", "fluid_particles",
                                            "wall_time", "rate",  "finished",  "blow_up_time"};
  return all;
}

std::vector<double> RunFacts::values() const {
  return {time, steps, particles, fluid, wall_time, rate, finished, blow_up_time};
}

Quantity read_quantity(const Table& table, const Expression::Variables& variables) {
  Quantity quantity{.name = table.text("name"),
                    .unit = table.text("unit", ""),
                    .meaning = table.text("meaning", ""),
                    .table = table,
                    .fact = {},
                    .formula = {},
                    .series = {},
                    .reference = {}};
  if (table.has("run")) {
    quantity.fact = table.choice("run", RunFacts::names());
  } else if (table.has("formula")) {
    quantity.formula = table.formula("formula", variables);
  } else {
    read_series(table, quantity);
  }
  return quantity;
}

void check_columns(const Quantity& quantity, const std::vector<SeriesColumn>& columns) {
  Expression::Variables names;
  for (const SeriesColumn& column : columns) names.push_back(column.name);
  (void)quantity.table.formula("column", names);
  if (quantity.reference && quantity.table.has("abscissa")) (void)quantity.table.formula("abscissa", names);
}

double measure(const Quantity& quantity, const CsvTable& file) {
  const auto names = names_of(file);
  const auto values = evaluate_rows(quantity.table.formula("column", names), file);
  if (!quantity.reference) return take_from(quantity, file.columns.at(0).values, values);
  const bool own = quantity.table.has("abscissa");
  const auto x = own ? evaluate_rows(quantity.table.formula("abscissa", names), file) : file.columns.at(0).values;
  return deviation(*quantity.reference, x, values);
}

}  // namespace undine::study
