#pragma once
#include <string>
#include <vector>

#include "undine/app/case_setup.hpp"
#include "undine/app/gauges/comparison.hpp"
#include "undine/app/run/options.hpp"
#include "undine/app/run/output.hpp"
#include "undine/app/run/pace.hpp"
#include "undine/io/run_record.hpp"

namespace undine {

/// What a run tells its user, and whoever follows its folder.
template <int N>
class RunTalk {
 public:
  RunTalk(const RunOptions& options, const CaseSetup<N>& setup, const OutputPlan& output)
      : options_(options), setup_(setup), output_(output) {}

  /// What the case resolved to; before the particles are moved into a flow.
  void describe() const;
  /// The stages of an evaluation, and what runs them.
  void plan(const Flow<N>& flow) const;
  /// A line now and then, and progress.json once a second.
  void progress(const Flow<N>& flow, const Pace& pace, const Step& step, bool last);
  void summary(const Flow<N>& flow, const Pace& pace, const EnergySeries<N>& energies,
               const std::vector<Comparison>& comparisons) const;
  /// A line of its own on standard error.
  void warn(const std::string& text) const;
  bool normal() const { return options_.verbosity == Verbosity::normal; }

 private:
  void path(const Flow<N>& flow) const;
  std::string progress_line(const Flow<N>& flow, const Pace& pace, const Step& step) const;

  const RunOptions& options_;
  const CaseSetup<N>& setup_;
  const OutputPlan& output_;
  Pace::Clock::time_point last_line_ = Pace::Clock::now(), last_file_ = {};
};

/// What run.json says of a run.
template <int N>
Json run_json(const Flow<N>& flow, const Pace& pace, const EnergySeries<N>& energies);

}  // namespace undine
