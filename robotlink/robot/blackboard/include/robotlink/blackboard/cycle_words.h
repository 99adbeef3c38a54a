// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Words in which programs announce their cycles: an int variable whose name ends in _CYCLE has n
// from the beginning of cycle n, and −n once all of it is written (docs/agent.md, docs/
// robot-programs.md). Pure functions; any thread.

#include <string_view>

#include <robotlink/blackboard/variable_catalog.h>

namespace pitchboard::link {

inline constexpr std::string_view cycleSuffix = "_CYCLE";

inline bool announcesCycles(const Variable& variable) {
  return variable.type == VariableType::Int && variable.name.ends_with(cycleSuffix);
}

}  // namespace pitchboard::link
