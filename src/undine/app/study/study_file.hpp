#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "undine/app/study/limit.hpp"
#include "undine/app/study/quantity.hpp"
#include "undine/app/study/verdict.hpp"
#include "undine/io/case/document.hpp"

namespace undine::study {

/// One value of an axis: what it sets in the case.
struct AxisValue {
  std::string name = {};
  std::vector<Table::Literal> set = {};
  std::filesystem::path base = {};  ///< another base case; empty: the study's
  double number = 0;                ///< for observed orders and formulas; NaN where there is none
  std::string from = {};            ///< value of the same axis whose member's last particles this one starts from
  std::string into = {};            ///< key of the case that takes their file
};

struct Axis {
  std::string name = {};
  std::vector<AxisValue> values = {};
};

/// Whether a member with these values is meant.
bool holds(const Selection& selection, const Choice& choice);

/// What a source found for some members.
struct Published {
  Selection selection = {};
  std::string source, reason = {};
  std::map<std::string, std::string> verdicts = {};
  std::map<std::string, double> quantities = {};
  double within = 0;  ///< relative deviation up to which a quantity agrees; 0: no judgement
};

/// Observed order of a quantity: q ~ x^order over the values of an axis.
struct OrderSpec {
  std::string quantity = {};
  std::size_t axis = 0;
};

/// A study file as it was read; formulas refer to columns and quantities by name.
struct StudyFile {
  std::string title = {};
  std::filesystem::path file = {};
  std::string command = {};           ///< that made the table, for people
  std::filesystem::path base = {};    ///< may be empty if every member's values name one
  bool measures_consistency = false;  ///< members are `undine approximate --consistency` in place of runs of a case
  bool is_long = false;               ///< `undine verify` takes it only if it is named
  bool quick = false;                 ///< reduced as its [quick] says
  std::vector<Table::Literal> set = {};
  std::vector<Table::Literal> quick_set = {};
  std::vector<Axis> axes = {};
  std::vector<Choice> members = {};
  std::vector<Quantity> quantities = {};
  std::vector<Verdict> verdicts = {};
  std::vector<Published> published = {};
  std::vector<OrderSpec> orders = {};
  std::vector<Limit> limits = {};

  /// What formulas of quantities and verdicts may name: facts of the run, axes, quantities.
  Expression::Variables variables() const;
};

/// Reads and checks the file, but for what only the cases can tell. `quick` reduces it as its [quick] says.
StudyFile read_study(const Document& document, const std::filesystem::path& file, bool quick);

}  // namespace undine::study
