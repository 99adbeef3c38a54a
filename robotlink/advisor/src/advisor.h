// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The advisor: a process of a robot that plays ahead what its decision may do next, and suggests
// what is best (ADVISOR_*, docs/advisor.md). It reads and writes its own robot's blackboard only.

#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

/// Fails on options that cannot be used.
Result<std::unique_ptr<CognitiveProcess>> makeAdvisor(const ProcessOptions& options);

}  // namespace pitchboard::link
