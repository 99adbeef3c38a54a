// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Every reference process of a robot, those of cognition and the advisor: the one list that
// programs, matches and tests read. Any thread.

#include <span>
#include <string_view>

#include <robotlink/cognition/process_registry.h>

namespace pitchboard::link {

/// In starting order.
std::span<const ProcessInfo> referenceProcesses();
/// Null for an unknown name.
const ProcessInfo* findProcess(std::string_view name);

}  // namespace pitchboard::link
