// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What happened in a step of the simulation, or by a referee's call. Plain values.

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
  Undone  ///< what a decision by hand had done before
};

/// `robot` is 0 when no robot is concerned. `value`: a goal and a corrected score have the side (0
/// left, 1 right), a kick and an unknown action their code, a state its PlayState, a half its
/// number, a phase its GamePhase, a set play its SetPlay, a penalty its PenaltyKind, Undone the
/// cause that it takes back.
struct Event {
  EventKind kind = EventKind::Goal;
  std::uint64_t tick = 0;
  RobotId robot;
  int value = 0;
  std::uint32_t cause = 0;  ///< the decision by hand that it follows from; 0: none
  bool operator==(const Event&) const = default;
};

}  // namespace pitchboard::sim
