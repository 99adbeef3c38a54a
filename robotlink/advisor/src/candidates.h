// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is worth thinking about, and between what to choose. Turned so that the robot's team attacks
// towards +x; metres. Pure functions.

#include <base/inline_vector.h>
#include <robotlink/cognition/advice.h>
#include <robotlink/cognition/situation.h>

namespace pitchboard::link {

enum class Question { None, AtBall, WhoGoes, Keeper };

/// The first says: as the behaviour would.
using Candidates = InlineVector<Advice, mostCandidates>;

struct Thinker {
  sim::FieldSpec field;
  sim::RobotModel model;
  bool isKeeper = false;
  BehaviourParameters numbers{};  ///< of its behaviour
};

/// Nobody can change a kick that goes on.
bool isKick(const Act& act);
/// The robot knows enough to think.
bool enoughIsKnown(const Situation& now);
/// Whether it matters now what the robot does; None unless it knows enough.
Question questionOf(const Situation& now, const Thinker& who);
/// `last`: what was suggested last; it is among them where it still fits.
Candidates candidatesFor(Question question, const Situation& now, const Thinker& who,
                         const Advice& last);

}  // namespace pitchboard::link
