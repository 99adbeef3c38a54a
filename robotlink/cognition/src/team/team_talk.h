// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

/// The team process, see team_talk.cpp. Fails when the UDP channel cannot be opened.
Result<std::unique_ptr<CognitiveProcess>> makeTeamTalk(const ProcessOptions& options);

}  // namespace pitchboard::link
