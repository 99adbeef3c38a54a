// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/advisor/reference_processes.h>

#include <algorithm>
#include <vector>

#include "advisor.h"

namespace pitchboard::link {

std::span<const ProcessInfo> referenceProcesses() {
  static const std::vector<ProcessInfo> all = [] {
    const auto first = cognitiveProcesses();
    std::vector<ProcessInfo> made(first.begin(), first.end());
    made.push_back({"advisor", "plays ahead what decision may do, and suggests what is best",
                    makeAdvisor, "pitchboard-robot advisor --robot 1 --behaviour striker"});
    return made;
  }();
  return all;
}

const ProcessInfo* findProcess(std::string_view name) {
  const auto all = referenceProcesses();
  const auto found = std::ranges::find(all, name, &ProcessInfo::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace pitchboard::link
