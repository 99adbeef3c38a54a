// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the localization process for the registry. Metres and radians inside, the published units
// on the blackboard. The process belongs to who asked for it, and to one thread at a time.

#include <memory>

#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

/// The localization process, see localization.cpp. Fails on a field or a number of particles that
/// cannot be used.
Result<std::unique_ptr<CognitiveProcess>> makeLocalization(const ProcessOptions& options);

}  // namespace pitchboard::link
