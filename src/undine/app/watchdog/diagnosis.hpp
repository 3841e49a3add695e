#pragma once
#include <string>
#include <vector>

#include "undine/app/watchdog/evidence.hpp"
#include "undine/io/run_record.hpp"

namespace undine {

/// What a run most likely went bad of, and what to change.
struct Diagnosis {
  std::string cause;  ///< name in `undine list causes`; "unknown" where none fits
  std::string title, because, remedy;
  std::vector<std::string> also;  ///< names of other causes that the evidence speaks for, the likelier first
};

/// The first cause of the list that holds.
Diagnosis diagnose(const Evidence& evidence);

/// One sentence on the alarm: "particle 17 ...".
std::string describe_alarm(const Evidence& evidence);

/// All of it for people, several lines.
std::string diagnosis_text(const Diagnosis& diagnosis, const Evidence& evidence);
/// The same for run.json.
Json diagnosis_json(const Diagnosis& diagnosis, const Evidence& evidence);

}  // namespace undine
