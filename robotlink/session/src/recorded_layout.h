// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where the groups of a recording keep what frames need: names are looked up once. A blackboard, a
// message and the truth call the same thing differently. Private to robotlink.

#include <array>
#include <optional>
#include <utility>

#include <robotlink/live/live_teams.h>
#include <robotlink/session/recorded_frame.h>
#include <robotlink/session/row_slot.h>

#include "game_columns.h"

namespace pitchboard::link {

using telemetry::FieldMeaning;

constexpr double timeTolerance = 1e-6;  // s; files keep whole nanoseconds

/// Where one group keeps what frames need.
struct RecordedFrames::Layout {
  static constexpr std::size_t flagCount = 5;
  Layout(const telemetry::GroupInfo& group, const telemetry::Profile* profile)
      : columns(group.columns.size()),
        live(attribute(group, "live") == "1"),
        attached(!live && attribute(group, "attached") == "1"),
        robot{attributeNumber(group, live ? "number" : "robot")},
        isMatch(robot.value == 0 && findSlot(group, {"BALL_X"}).present()) {
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
    player.emplace(group);
    trueX = findSlot(group, {"TRUE_X"});
    trueY = findSlot(group, {"TRUE_Y"});
    trueYaw = findSlot(group, {"TRUE_YAW"});
    headYaw = findSlot(group, {"HEAD_YAW"});
    vx = findSlot(group, {"VX"});
    vy = findSlot(group, {"VY"});
    action = findSlot(group, {"ACTION", "CONTROL_ACTION", "ACTION_A", "DECISION_ACTION_A"});
    fallen = findSlot(group, {"FALLEN", "IMU_STATE"});
    distance = findSlot(group, {"DISTANCE_WALKED"});
    kicks = findSlot(group, {"KICKS"});
    falls = findSlot(group, {"FALLS"});
    unknownActions = findSlot(group, {"UNKNOWN_ACTIONS"});
    lastUnknown = findSlot(group, {"LAST_UNKNOWN_ACTION"});
    actionA = findSlot(group, FieldMeaning::Action);
    voltage = findSlot(group, FieldMeaning::Voltage);
    lost = findSlot(group, {"VISION_LOST"});
    ballDist = findSlot(group, FieldMeaning::BallDistance);
    pan = findSlot(group, FieldMeaning::BallAngle);
    locX = findSlot(group, FieldMeaning::X);
    locY = findSlot(group, FieldMeaning::Y);
    locTheta = findSlot(group, FieldMeaning::Theta);
    belief = findSlot(group, FieldMeaning::Belief);
    flags = {findSlot(group, FieldMeaning::Control), findSlot(group, FieldMeaning::Vision),
             findSlot(group, FieldMeaning::Localization), findSlot(group, FieldMeaning::Decision),
             findSlot(group, FieldMeaning::Imu)};
    age = findSlot(group, {"LINK_AGE", "AGE"});
    rate = findSlot(group, {"LINK_RATE", "RATE"});
    loss = findSlot(group, {"LINK_LOSS", "LOSS"});
    errors = findSlot(group, {"LINK_ERRORS", "ERRORS"});
    volts = findSlot(group, {"LINK_VOLTS", "VOLTS"});
    jitter = findSlot(group, {"JITTER"});
    lostMessages = findSlot(group, {"LOST"});
    duplicates = findSlot(group, {"DUPLICATES"});
    late = findSlot(group, {"LATE"});
    // A robot of a team setup says itself what its columns mean.
    const bool says = !attribute(group, "profile").empty();
    if (!live || (!profile && !says)) return;
    // A team's own names.
    const std::pair<FieldMeaning, RowSlot*> meanings[] = {{FieldMeaning::X, &locX},
                                                          {FieldMeaning::Y, &locY},
                                                          {FieldMeaning::Theta, &locTheta},
                                                          {FieldMeaning::Belief, &belief},
                                                          {FieldMeaning::BallDistance, &ballDist},
                                                          {FieldMeaning::BallAngle, &pan},
                                                          {FieldMeaning::Action, &actionA},
                                                          {FieldMeaning::Voltage, &voltage},
                                                          {FieldMeaning::Control, &flags[0]},
                                                          {FieldMeaning::Vision, &flags[1]},
                                                          {FieldMeaning::Localization, &flags[2]},
                                                          {FieldMeaning::Decision, &flags[3]},
                                                          {FieldMeaning::Imu, &flags[4]}};
    for (const auto& [meaning, slot] : meanings) {
      const auto place = says ? std::nullopt : profile->indexOf(meaning);
      const std::string name = place  ? profile->fields[*place].name
                               : says ? std::string(attribute(group, meaningAttribute(meaning)))
                                      : std::string();
      *slot = name.empty() ? RowSlot{} : findSlot(group, {name.c_str()});
    }
    action = actionA;
  }

  std::size_t columns;
  bool live;
  bool attached;  ///< a blackboard of the computer that recorded
  RobotId robot;
  bool isMatch;
  RowSlot tick, ballX, ballY, ballVx, ballVy, clock, clockRunning, scoreLeft, scoreRight, tickTime;
  RowSlot trueX, trueY, trueYaw, headYaw, vx, vy, action, fallen, distance, kicks, falls,
      unknownActions, lastUnknown;
  RowSlot actionA, voltage, lost, ballDist, pan, locX, locY, locTheta, belief, age, rate, loss,
      errors, volts, jitter, lostMessages, duplicates, late;
  std::array<RowSlot, flagCount> flags;
  std::optional<GameSlots> game;      // of the match
  std::optional<PlayerSlots> player;  // of a robot
};

}  // namespace pitchboard::link
