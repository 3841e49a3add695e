#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace undine::study {

/// For each axis, the number of the value that a member has.
using Choice = std::vector<std::size_t>;

/// For each axis, the values that are meant; none: all of them.
using Selection = std::vector<std::vector<std::size_t>>;

/// What a quantity of some members, or an observed order, must keep.
struct Limit {
  std::string metric = {};  ///< what the table calls it
  std::string quantity = {};
  std::optional<std::size_t> order_over = {};  ///< the axis, if the observed order of the quantity is meant
  Selection selection = {};
  std::optional<std::size_t> relative_axis = {};  ///< the number is that over the one of the member with
  std::size_t relative_value = 0;                 ///< this value of this axis, other values being equal
  double at_least = -std::numeric_limits<double>::infinity();
  double at_most = std::numeric_limits<double>::infinity();
  bool worst = false;  ///< one number for all members: the one that is farthest from what is wanted
  bool quick = false;  ///< also judged in the reduced study
  std::string source = {};

  bool bounded_above() const { return at_most < std::numeric_limits<double>::infinity(); }
  bool bounded_below() const { return at_least > -std::numeric_limits<double>::infinity(); }
};

/// One line of the scored table.
struct Score {
  std::string metric;
  double value;  ///< NaN: could not be measured
  double limit;  ///< NaN: none, the number is only shown
  bool is_upper = true;
  std::string unit = {}, source = {};

  /// "<= 0.05"; empty where there is none.
  std::string limit_text() const;
  bool limited() const { return limit == limit; }
  /// Whether the limit is kept; what could not be measured does not keep it.
  bool pass() const { return !limited() || (is_upper ? value <= limit : value >= limit); }
  /// Whether the limit is kept, for tables: "yes", "NO", or nothing where there is none.
  std::string kept_text() const { return !limited() ? "" : pass() ? "yes" : "NO"; }
};

struct StudyFile;
struct Member;
struct ResultTable;

/// The limits against the results; in a reduced study, those that are also meant there and whose members it has.
std::vector<Score> judge_limits(const StudyFile& study, const std::vector<Member>& members, const ResultTable& table);

}  // namespace undine::study
