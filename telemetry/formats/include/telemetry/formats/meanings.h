// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What each FieldMeaning is called in profiles, on the blackboard and in the published message, and
// its unit there. This is the only such table. Constant data; any thread.

#include <array>
#include <string_view>

#include <base/units.h>
#include <telemetry/formats/profile.h>

namespace pitchboard::telemetry {

struct MeaningInfo {
  FieldMeaning meaning = FieldMeaning::None;
  std::string_view profileKey;  ///< its name in profile files; never change it
  std::string_view
      variable;              ///< blackboard variable; empty if none. VISION_LOST means the opposite
  std::string_view oldName;  ///< its name in Live up to version 0.8, see presentName()
  std::string_view unit;     ///< unit of the variable
  std::string_view category;
  UnitKind kind = UnitKind::None;  ///< None: the value stays as it is sent
};

inline constexpr std::array<MeaningInfo, fieldMeaningCount> meaningTable = [] {
  using M = FieldMeaning;
  using K = UnitKind;
  return std::array<MeaningInfo, fieldMeaningCount>{{
      {M::None, "none", "", "", "", "", K::None},
      {M::Robot, "robot", "", "n", "", "Robot", K::None},
      {M::X, "x", "LOCALIZATION_X", "X", "cm", "Belief", K::Length},
      {M::Y, "y", "LOCALIZATION_Y", "Y", "cm", "Belief", K::Length},
      {M::Theta, "theta", "LOCALIZATION_THETA", "THETA", "°", "Belief", K::Angle},
      // The published localization publishes its belief under this name (system.md section 5).
      {M::Belief, "belief", "LOCALIZATION_RBT01_X", "BELIEF", "cm", "Belief", K::Length},
      {M::BallDistance, "ball-distance", "VISION_BALL_DIST", "BALL_DIST", "cm", "Vision",
       K::Length},
      {M::BallAngle, "ball-angle", "VISION_PAN_DEG", "BALL_ANGLE", "°", "Vision", K::Angle},
      {M::Control, "control", "CONTROL_WORKING", "CONTROL", "", "Processes", K::None},
      {M::Vision, "vision", "VISION_WORKING", "VISION", "", "Processes", K::None},
      {M::Localization, "localization", "LOCALIZATION_WORKING", "LOCALIZATION", "", "Processes",
       K::None},
      {M::Decision, "decision", "DECISION_WORKING", "DECISION", "", "Processes", K::None},
      {M::Imu, "imu", "IMU_WORKING", "IMU", "", "Processes", K::None},
      {M::Action, "action", "DECISION_ACTION_A", "ACTION_A", "", "Decision", K::None},
      {M::Yaw, "yaw", "IMU_EULER_Z", "IMU_EULER_Z", "rad", "IMU", K::None},
      {M::Voltage, "voltage", "VOLTAGE", "VOLTAGE", "0.1 V", "Robot", K::Voltage},
      {M::Sequence, "sequence", "", "", "", "", K::None},
      {M::Team, "team", "", "", "", "", K::None},
      {M::BallX, "ball-x", "", "", "", "", K::Length},
      {M::BallY, "ball-y", "", "", "", "", K::Length},
      {M::BallFieldX, "ball-field-x", "", "", "", "", K::Length},
      {M::BallFieldY, "ball-field-y", "", "", "", "", K::Length},
      {M::BallSeen, "ball-seen", "VISION_LOST", "", "", "Vision", K::None},
      {M::BallAge, "ball-age", "", "", "", "", K::Time},
      {M::Charge, "charge", "CHARGE", "", "%", "Robot", K::Share},
  }};
}();

constexpr const MeaningInfo& info(FieldMeaning meaning) {
  return meaningTable[static_cast<std::size_t>(meaning)];
}

/// Returns the present name of a column that Live called `name` up to version 0.8; other names are
/// returned unchanged.
constexpr std::string_view presentName(std::string_view name) {
  for (const MeaningInfo& known : meaningTable) {
    if (!known.variable.empty() && known.oldName == name) return known.variable;
  }
  return name;
}

static_assert(
    [] {
      for (std::size_t i = 0; i < meaningTable.size(); ++i) {
        if (meaningTable[i].meaning != static_cast<FieldMeaning>(i) ||
            meaningTable[i].profileKey.empty())
          return false;
      }
      return true;
    }(),
    "every FieldMeaning needs its row, in their order");

}  // namespace pitchboard::telemetry
