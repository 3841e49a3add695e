#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "undine/app/study/member.hpp"

namespace undine::study {

/// What a member came to.
struct Row {
  std::vector<double> values = {};                    ///< facts, numbers of axes, quantities: as StudyFile::variables
  std::vector<std::string> verdicts = {};             ///< in the file's order
  std::map<std::string, std::string> published = {};  ///< by name of a verdict or quantity
  std::map<std::string, bool> agrees = {};            ///< where there is something to compare
  std::vector<std::string> reasons = {};
};

struct Order {
  std::string quantity, axis = {};
  std::map<std::string, std::string> group = {};  ///< values of the other axes
  Choice choice = {};                             ///< the same by number; 0 for the axis itself
  double order = 0;                               ///< NaN where fewer than two members have a positive number
};

/// The results of a study so far.
struct ResultTable {
  std::vector<Row> rows = {};  ///< as the members
  std::vector<Order> orders = {};
};

ResultTable tabulate(const StudyFile& study, const std::vector<Member>& members);

}  // namespace undine::study
