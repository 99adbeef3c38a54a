// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Puts robots whose blackboards are received (attached on this computer, or sent by
// pitchboard-agent) into a frame. A robot that sends messages as well is one robot, in Live as in a
// recording: both call this. Pure; any thread.

#include <vector>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// RobotKey::team of a received blackboard of which only the colour is known.
inline constexpr int placeByColour = -1;

/// Each of `boards` has a number, a colour and a link. One with the address of a sender is the
/// robot that sends messages with its number from there. One without is a blackboard of this
/// computer: it is the robot of its number and colour, or of a team whose colour is not known.
/// Where there is none it becomes a robot of its own, of the team at its place or of its colour.
/// While a blackboard is received, it says where the robot is, what it sees and does; messages say
/// it otherwise. Returns the keys under which they are in the frame, in the order of `boards`.
std::vector<RobotKey> joinBoards(MatchFrame& frame, std::vector<RobotFrame> boards);

}  // namespace pitchboard::link
