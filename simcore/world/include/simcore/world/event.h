// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Events of a step of the simulation or of a referee's call. Plain values; any thread.

#include <cstdint>

#include <base/ids.h>

namespace pitchboard::sim {

enum class EventKind : std::uint8_t {
  Goal,
  BallOut,
  Kick,
  Fall,
  GotUp,
  UnknownAction,
  ScoreCorrected,
  PlayStateChanged,
  HalfBegan,
  PhaseChanged,
  SetPlayBegan,
  SetPlayOver,
  DropBall,
  PlayStopped,
  PlayGoesOn,
  Penalised,
  PenaltyOver,
  FinalWhistle,
  SettingChanged,  ///< a Setting was changed by hand
  Undone,          ///< the effects of a call or change by hand were undone
  CoinToss         ///< a coin decided the shoot-out
};

/// What a user can change while a match goes on.
enum class Setting : std::uint8_t { Noise, Physics, Rules, ScoreAndClock };

/// `robot` is 0 if no robot is concerned. `value` depends on the kind: the side of a goal or
/// corrected score (0 left, 1 right), the code of a kick or unknown action, the PlayState, the
/// number of the half, the GamePhase, the SetPlay, the PenaltyKind, the Setting, the cause that
/// Undone refers to, or the index of the team that won the toss.
struct Event {
  EventKind kind = EventKind::Goal;
  std::uint64_t tick = 0;
  RobotId robot;
  int value = 0;
  std::uint32_t cause = 0;  ///< number of the call or change by hand that caused it; 0: none
  bool operator==(const Event&) const = default;
};

}  // namespace pitchboard::sim
