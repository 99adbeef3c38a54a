// SPDX-License-Identifier: GPL-3.0-or-later
#include <robotlink/live/board_facts.h>
#include <robotlink/live/robot_uids.h>

#include "uid_ranges.h"

namespace pitchboard::link {

RobotUid uidOfBoard(int boardKey) {
  return {uid_ranges::ofBoardKey | (static_cast<std::uint32_t>(boardKey) & uid_ranges::mask)};
}

telemetry::RobotFacts factsOfBoard(int boardKey, double rate) {
  telemetry::RobotFacts facts;
  facts.boardKey = boardKey;
  facts.attached = true;
  facts.rate_hz = rate;
  return facts;
}

telemetry::RobotFacts factsOfBoard(int boardKey, double rate, int number, TeamColor team) {
  telemetry::RobotFacts facts = factsOfBoard(boardKey, rate);
  facts.uid = uidOfBoard(boardKey);
  facts.slot = facts.number = number;
  facts.team = team;
  return facts;
}

}  // namespace pitchboard::link
