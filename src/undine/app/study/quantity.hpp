#pragma once
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "undine/io/case/table.hpp"
#include "undine/io/time_series.hpp"

namespace undine::study {

/// What run.json and the exit of a member tell.
struct RunFacts {
  double time = 0;       ///< reached, s
  double steps = 0;      ///< taken
  double particles = 0;  ///< fluid and wall
  double fluid = 0;
  double wall_time = 0;                                           ///< s
  double rate = 0;                                                ///< particle updates/s
  double finished = 0;                                            ///< 1 if the run reached its end, else 0
  double blow_up_time = std::numeric_limits<double>::infinity();  ///< s; infinite if it did not go bad

  static const std::vector<std::string>& names();
  std::vector<double> values() const;
};

/// How a number is taken from a series of samples in a window of time.
enum class Take { last, first, max, min, mean, rms, growth, growth_rate, rise, ripple, time_to, deviation };

/// Published numbers y over x.
struct ReferenceSeries {
  std::vector<double> x, y = {};  ///< x ascending
  double shift = 0;               ///< largest common shift of x that may be taken out
  bool relative = false;          ///< deviation over the range of y
};

/// A number of each member, by name.
struct Quantity {
  std::string name, unit, meaning = {};
  Table table;  ///< its lines in the study file; formulas are read from it once the columns are known

  std::string fact = {};                   ///< name of a fact of the run; or
  std::optional<Expression> formula = {};  ///< of facts, axes and the quantities above it; or
  std::string series = {};                 ///< "energies" or the name of a gauge, and
  Take take = Take::last;
  double start = 0, end = std::numeric_limits<double>::infinity();  ///< window of time, s
  double period = 0;                                                ///< of ripple: what varies slower is taken out, s
  double threshold = 0;                                             ///< of time_to
  bool above = false;  ///< time_to is when the value is above the threshold, else below
  bool stays = false;  ///< and stays there
  std::optional<ReferenceSeries> reference = {};
};

/// Reads one [[quantity]]; `variables` may occur in its formula.
Quantity read_quantity(const Table& table, const Expression::Variables& variables);

/// Throws InputError if the quantity's column (and abscissa) are not formulas of these columns.
void check_columns(const Quantity& quantity, const std::vector<SeriesColumn>& columns);

/// The number of a finished or broken run, from its file; NaN where there is nothing to measure.
double measure(const Quantity& quantity, const CsvTable& file);

/// y against ascending times: what `take` says.
double take_from(const Quantity& quantity, const std::vector<double>& times, const std::vector<double>& values);

/// Root mean square of (ours, linear between samples) - reference where both are known, after the shift of x (at most
/// reference.shift) that makes it smallest.
double deviation(const ReferenceSeries& reference, const std::vector<double>& x, const std::vector<double>& y);

}  // namespace undine::study
