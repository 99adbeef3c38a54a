// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the team process for the registry: what the robots of a team tell each other. The process
// belongs to who asked for it, and to one thread at a time.

#include <memory>

#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

/// The team process, see team_talk.cpp. Fails when the UDP channel cannot be opened.
Result<std::unique_ptr<CognitiveProcess>> makeTeamTalk(const ProcessOptions& options);

}  // namespace pitchboard::link
