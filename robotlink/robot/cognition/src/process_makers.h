// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What makes the processes of the registry. A process belongs to who asked for it, and to one
// thread at a time. All fail on options that cannot be used.

#include <robotlink/cognition/cognitive_process.h>

namespace pitchboard::link {

using ProcessMaker = Result<std::unique_ptr<CognitiveProcess>>(const ProcessOptions& options);

/// localization.cpp. Metres and radians inside, the published units on the blackboard.
ProcessMaker makeLocalization;
/// planning.cpp. Between decision and control: reads decision's target, the pose and where others
/// stand, writes the path and the action. It acts only while decision has set a target, so that a
/// robot whose decision kicks or turns by itself is left alone. Ten times a second.
ProcessMaker makePlanning;
/// communication.cpp: telemetry, team messages and the referee, all by UDP. Fails also when the
/// system gives no socket.
ProcessMaker makeCommunication;
/// team_talk.cpp: what the robots of a team tell each other. Fails also without a UDP channel.
ProcessMaker makeTeamTalk;
/// advisor.cpp: learns where the opponents aim. Fails also when its memory cannot be read.
ProcessMaker makeAdvisor;

}  // namespace pitchboard::link
