// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where all other robots stand that a robot knows of, from its blackboard: team-mates as the team
// process writes them, opponents as decision remembers them. Studio frame, metres. Use from one
// thread.

#include <robotlink/cognition/soccer_input.h>
#include <simcore/world/field.h>

#include "team/team_variables.h"

namespace pitchboard::link {

class KnownRobots {
 public:
  void read(const Blackboard& board, const sim::FieldSpec& field, Points& places) const;

 private:
  TeamVariables m_team;
};

}  // namespace pitchboard::link
