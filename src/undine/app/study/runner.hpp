#pragma once
#include <functional>
#include <vector>

#include "undine/app/study/member.hpp"

namespace undine::study {

struct RunnerOptions {
  int jobs = 1;       ///< members at a time
  double memory = 0;  ///< bytes that members may take together
};

/// Bytes that programs can still take on this machine.
double available_memory();

/// Runs the chosen members that are not done, each in a process of its own, so that none can bring down another. A
/// member that starts from another waits for it. `report(member)` is called when one starts or ends, here in this
/// thread. Returns false if the user interrupted: the members have then kept a checkpoint each.
bool run_members(std::vector<Member>& members, const RunnerOptions& options,
                 const std::function<void(const Member&)>& report);

}  // namespace undine::study
