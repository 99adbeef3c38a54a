// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Lists all reference processes of a robot: those of cognition, and the advisor. Programs, matches
// and tests read this list. Pure functions; any thread.

#include <span>
#include <string_view>

#include <robotlink/cognition/process_registry.h>

namespace pitchboard::link {

/// Returns the processes in the order in which they are started.
std::span<const ProcessInfo> referenceProcesses();
/// Returns a process by name; null for an unknown one.
const ProcessInfo* findProcess(std::string_view name);

}  // namespace pitchboard::link
