// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the groups of a recording keep what frames need: names are looked up once. Private to
// robotlink.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/row_slot.h>

#include "game_columns.h"

namespace pitchboard::link {

using telemetry::FieldMeaning;

constexpr double timeTolerance = 1e-6;  // s; files keep whole nanoseconds

constexpr FieldMeaning lampOf(std::size_t lamp) {
  return static_cast<FieldMeaning>(static_cast<std::size_t>(FieldMeaning::Control) + lamp);
}

/// Where one group keeps what frames need.
struct RecordedFrames::Layout {
  explicit Layout(const telemetry::GroupInfo& group)
      : attached(factsOf(group).attached),
        isImported(!factsOf(group).recordedBy.empty()),
        sent(telemetry::parseAddress(factsOf(group).sentFrom).value_or(telemetry::Address{})),
        // Robots of Live are made from their datagrams (LiveMoments).
        robot{factsOf(group).live ? 0 : factsOf(group).slot},
        isMatch(robot.value == 0 && findSlot(group, {"BALL_X"}).present()) {
    for (const telemetry::ColumnInfo& column : group.columns) types.push_back(column.type);
    if (isMatch) {
      tick = findSlot(group, {"TICK"});
      ballX = findSlot(group, {"BALL_X"});
      ballY = findSlot(group, {"BALL_Y"});
      ballVx = findSlot(group, {"BALL_VX"});
      ballVy = findSlot(group, {"BALL_VY"});
      clock = findSlot(group, {"CLOCK"});
      clockRunning = findSlot(group, {"CLOCK_RUNNING"});
      scoreLeft = findSlot(group, {"SCORE_LEFT"});
      scoreRight = findSlot(group, {"SCORE_RIGHT"});
      tickTime = findSlot(group, {"TICK_TIME"});
      game.emplace(group);
      return;
    }
    if (isBoard()) {
      auto names = std::make_shared<std::vector<std::string>>();
      for (const telemetry::ColumnInfo& column : group.columns) {
        names->push_back(column.name);
        board.push_back(findSlot(group, {column.name}));
      }
      boardNames = std::move(names);
    }
    player.emplace(group);
    trueX = findSlot(group, {"TRUE_X"});
    trueY = findSlot(group, {"TRUE_Y"});
    trueYaw = findSlot(group, {"TRUE_YAW"});
    headYaw = findSlot(group, {"HEAD_YAW"});
    vx = findSlot(group, {"VX"});
    vy = findSlot(group, {"VY"});
    action = findSlot(group, {"ACTION", "CONTROL_ACTION", "DECISION_ACTION_A"});
    fallen = findSlot(group, {"FALLEN", "IMU_STATE"});
    distance = findSlot(group, {"DISTANCE_WALKED"});
    kicks = findSlot(group, {"KICKS"});
    falls = findSlot(group, {"FALLS"});
    unknownActions = findSlot(group, {"UNKNOWN_ACTIONS"});
    lastUnknown = findSlot(group, {"LAST_UNKNOWN_ACTION"});
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const std::string_view name = telemetry::meaningTable[i].variable;
      if (!name.empty()) variables[i] = findSlot(group, {name});
    }
  }

  const RowSlot& of(FieldMeaning meaning) const {
    return variables[static_cast<std::size_t>(meaning)];
  }

  bool isBoard() const { return attached || isImported || sent != telemetry::Address{}; }

  std::vector<telemetry::ColumnType> types;  ///< of the columns
  bool attached;                             ///< a blackboard of the computer that recorded
  bool isImported;                           ///< of the recording of another program
  telemetry::Address sent;  ///< of the robot that sent this blackboard; 0: none did
  RobotId robot;
  bool isMatch;
  std::vector<RowSlot> board;  // of a received blackboard: all of its columns
  std::shared_ptr<const std::vector<std::string>> boardNames;
  RowSlot tick, ballX, ballY, ballVx, ballVy, clock, clockRunning, scoreLeft, scoreRight, tickTime;
  RowSlot trueX, trueY, trueYaw, headYaw, vx, vy, action, fallen, distance, kicks, falls,
      unknownActions, lastUnknown;
  std::array<RowSlot, telemetry::fieldMeaningCount> variables;  // of the blackboard
  std::optional<GameSlots> game;                                // of the match
  std::optional<PlayerSlots> player;                            // of a robot
};

}  // namespace pitchboard::link
