// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Adds robots whose blackboards are received (attached on this computer, or sent by
// pitchboard-agent) to a frame. A robot that also sends messages becomes one robot. Used for Live
// and for recordings. Pure function; any thread.

#include <vector>

#include <robotlink/frame/match_frame.h>

namespace pitchboard::link {

/// RobotKey::team of a received blackboard of which only the colour is known.
inline constexpr int placeByColour = -1;

/// Joins each of `boards`, which have an uid, a number, a colour and a link, with a robot of the
/// frame:
/// - A blackboard with the uid of a robot belongs to it.
/// - A blackboard that was sent from an address belongs to the robot with its number that sends
///   messages from the same address, in its team before others. Programs on one computer share
///   their address, so that they belong together in one team only.
/// - A blackboard of this computer belongs to the robot with its number and colour, or to one with
///   its number in a team whose colour is unknown.
/// - If there is no such robot, the blackboard becomes a robot of its own.
/// While a blackboard is received, pose, percepts and action come from it, otherwise from messages.
/// Returns the robots of the frame that they are, in the order of `boards`.
std::vector<RobotUid> joinBoards(MatchFrame& frame, std::vector<RobotFrame> boards);

}  // namespace pitchboard::link
